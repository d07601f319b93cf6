# The floating-point contract: what every translation unit must be compiled with so that the same source gives
# the same bits on every compiler, optimisation level and core. Included by the root CMakeLists.txt only.
#
#   -ffp-contract=off     a*b+c is two roundings everywhere; GCC and clang fuse by default on M4F, M7, -march=native
#   -fno-math-errno       __builtin_sqrtf becomes the instruction, not a call that sets errno
#   -fno-fast-math        against anything inherited from the environment's CXXFLAGS; it comes first, because it
#                         also restores -fmath-errno, and with it a call of sqrtf
#   EIGEN_DONT_VECTORIZE  SSE/AVX sum in another order; in *every* unit, or object layouts differ (ODR)
#   EIGEN_NO_MALLOC       a heap allocation inside Eigen becomes an assertion
add_library(verp_floating_point INTERFACE)
target_compile_options(verp_floating_point INTERFACE
  $<$<COMPILE_LANGUAGE:C,CXX>:-fno-fast-math -ffp-contract=off -fno-math-errno>)
target_compile_definitions(verp_floating_point INTERFACE EIGEN_DONT_VECTORIZE)
