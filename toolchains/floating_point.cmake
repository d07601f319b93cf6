# The floating-point contract, for every translation unit: the same source gives the same bits on every compiler,
# optimisation level and core.
#
#   -ffp-contract=off     a*b+c rounds twice everywhere; by default GCC and clang fuse it on M4F, M7, -march=native
#   -fno-math-errno       __builtin_sqrtf becomes the instruction, not a call that sets errno
#   -fno-fast-math        overrides the environment's CXXFLAGS; comes first, because it also restores -fmath-errno,
#                         and with it a call of sqrtf
#   EIGEN_DONT_VECTORIZE  SSE/AVX sums in another order; in *every* unit, or object layouts differ (ODR)
#   EIGEN_NO_MALLOC       a heap allocation inside Eigen becomes an assertion
add_library(verp_floating_point INTERFACE)
target_compile_options(verp_floating_point INTERFACE
  $<$<COMPILE_LANGUAGE:C,CXX>:-fno-fast-math -ffp-contract=off -fno-math-errno>)
target_compile_definitions(verp_floating_point INTERFACE EIGEN_DONT_VECTORIZE)
