# Warnings are errors, with GCC and clang alike.
add_library(verp_warnings INTERFACE)
target_compile_options(verp_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Werror)
