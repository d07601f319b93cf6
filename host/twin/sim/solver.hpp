#pragma once
#include <cstddef>
#include <span>
#include <string_view>

/// Replacements for three loops of ODE's solver, which take most of a world's time. They process
/// several numbers at a time and skip zeros at the start of rows; the same terms in the same order
/// give the same bits (tests/host/sim/solver_test.cpp).
///
/// The dynamic linker binds ODE's calls to the first definition, which a shared library must export
/// (host/apps/libverp/exported.map). On another processor or ODE, ODE's own loops run.

namespace verp::sim {

struct SolverLoops {
  std::string_view instructions;
  /// Solves L x = b in place of b. L: n rows, `skip` numbers apart, lower, unit diagonal.
  void (*solve_lower)(const double* l, double* b, std::size_t n, std::size_t skip);
  /// Solves L^T x = b. Room: n numbers.
  void (*solve_upper)(const double* l, double* b, std::size_t n, std::size_t skip, double* room);
  /// Factors A = L D L^T: L over A's lower half, 1 / D in d. Room: 8 n numbers.
  void (*factor)(double* a, double* d, std::size_t n, std::size_t skip, double* room);
};

/// All for this processor, the used one first; empty: ODE's own run.
std::span<const SolverLoops> solver_loops();

}  // namespace verp::sim
