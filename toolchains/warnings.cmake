# Warnings are errors, with GCC and clang alike. One exception: GCC 12's -Wrestrict sees overlaps in std::string's
# operator+ that are not there (GCC bug 105651, mended in GCC 13).
add_library(verp_warnings INTERFACE)
target_compile_options(verp_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
