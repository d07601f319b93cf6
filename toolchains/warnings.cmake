# Warnings are errors, with GCC and clang alike. Two exceptions: GCC 12's -Wrestrict sees overlaps in std::string's
# operator+ that are not there (GCC bug 105651, mended in GCC 13); and where files are compiled many at a time it takes the
# types in their unnamed namespaces for a header's.
add_library(verp_warnings INTERFACE)
target_compile_options(verp_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wno-subobject-linkage>)
