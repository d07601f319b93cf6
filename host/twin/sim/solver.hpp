#pragma once
#include <cstddef>
#include <span>
#include <string_view>

/// Replacements for three loops of ODE's solver that take most of a world's time. They process
/// several numbers at a time and skip the zeros at the start of a robot's rows. Each result is the
/// sum of the same terms in the same order, so no bit differs (tests/host/sim/solver_test.cpp).
///
/// A program linked with this file uses them instead of ODE's. The dynamic linker binds the
/// library's own calls to the first definition it finds; a shared library must export them for that
/// (host/apps/libverp/exported.map). On another processor, or with an ODE that has other loops,
/// ODE's own run.

namespace verp::sim {

struct SolverLoops {
  std::string_view instructions;
  /// Solves L x = b in place of b. L: n rows, `skip` numbers apart, lower, unit diagonal.
  void (*solve_lower)(const double* l, double* b, std::size_t n, std::size_t skip);
  /// Solves L^T x = b. Room: n numbers.
  void (*solve_upper)(const double* l, double* b, std::size_t n, std::size_t skip, double* room);
  /// Factors A = L D L^T: L in place of A's lower half, 1 / D in d. Room: 8 n numbers.
  void (*factor)(double* a, double* d, std::size_t n, std::size_t skip, double* room);
};

/// All variants for this processor, the one in use first; empty: ODE's own run.
std::span<const SolverLoops> solver_loops();

}  // namespace verp::sim
