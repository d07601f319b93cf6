#pragma once
#include <cstddef>
#include <span>
#include <string_view>

/// Three loops of ODE's solver take most of a world's time. Here they are once more, several
/// numbers at a time and without the zeros that a robot's rows begin with: each number is the sum
/// of the same terms in the same order, so no bit of it differs (tests/host/sim/solver_test.cpp). A
/// program with this file in it has them in the place of ODE's, as the dynamic linker binds the
/// library's own calls to the first definition that it finds; a shared library must export them
/// for that (host/apps/libverp/exported.map). Where it finds none, on another processor or with an
/// ODE that has other loops, ODE's own run.

namespace verp::sim {

struct SolverLoops {
  std::string_view instructions;
  /// L x = b, in the place of b. L: n rows, `skip` numbers apart, lower, with ones on its diagonal.
  void (*solve_lower)(const double* l, double* b, std::size_t n, std::size_t skip);
  /// L^T x = b. Room: n numbers.
  void (*solve_upper)(const double* l, double* b, std::size_t n, std::size_t skip, double* room);
  /// A = L D L^T: L in the place of A's lower half, 1 / D in d. Room: 8 n numbers.
  void (*factor)(double* a, double* d, std::size_t n, std::size_t skip, double* room);
};

/// All that this processor has, the one in use first; none: ODE's own are.
std::span<const SolverLoops> solver_loops();

}  // namespace verp::sim
