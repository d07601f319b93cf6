# Warnings are errors, with GCC and clang. Exceptions: GCC 12's -Wrestrict reports false overlaps in std::string's
# operator+ (GCC bug 105651, fixed in GCC 13). In unity builds it takes types in unnamed namespaces for a header's.
add_library(verp_warnings INTERFACE)
target_compile_options(verp_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wno-subobject-linkage>)
