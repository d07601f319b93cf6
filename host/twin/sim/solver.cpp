#include "host/twin/sim/solver.hpp"

#if defined(__x86_64__)
#include <vector>

#include "host/twin/sim/solver_lanes.hpp"

// These are exported template instances of ODE.
#define VERP_IN_PLACE_OF(name) __asm__(name) __attribute__((visibility("default")))
extern "C" {
void verp_solve_lower(const double* l, double* b, unsigned n, unsigned skip)
    VERP_IN_PLACE_OF("_Z15solveL1StraightILj1EEvPKdPdjj");
void verp_solve_upper(const double* l, double* b, unsigned n, unsigned skip)
    VERP_IN_PLACE_OF("_Z17solveL1TransposedILj1EEvPKdPdjj");
void verp_factor(double* a, double* d, unsigned n, unsigned skip)
    VERP_IN_PLACE_OF("_Z18factorMatrixAsLDLTILj1EEvPdS0_jj");
}

namespace verp::sim {
namespace {

#define VERP_WIDE __attribute__((target("avx2")))
VERP_WIDE void solve_lower_wide(const double* l, double* b, std::size_t n, std::size_t skip) {
  lanes::solve_lower(l, b, n, skip);
}
VERP_WIDE void solve_upper_wide(const double* l, double* b, std::size_t n, std::size_t skip,
                                double* room) {
  lanes::solve_upper(l, b, n, skip, room);
}
VERP_WIDE void factor_wide(double* a, double* d, std::size_t n, std::size_t skip, double* room) {
  lanes::factor(a, d, n, skip, room);
}

void solve_lower_narrow(const double* l, double* b, std::size_t n, std::size_t skip) {
  lanes::solve_lower(l, b, n, skip);
}
void solve_upper_narrow(const double* l, double* b, std::size_t n, std::size_t skip, double* room) {
  lanes::solve_upper(l, b, n, skip, room);
}
void factor_narrow(double* a, double* d, std::size_t n, std::size_t skip, double* room) {
  lanes::factor(a, d, n, skip, room);
}

constexpr SolverLoops kLoops[] = {
    {"AVX2", solve_lower_wide, solve_upper_wide, factor_wide},
    {"SSE2", solve_lower_narrow, solve_upper_narrow, factor_narrow},
};
const std::size_t kFirst = __builtin_cpu_supports("avx2") ? 0 : 1;

/// Scratch, kEach numbers per row.
template <std::size_t kEach>
class Room {
 public:
  explicit Room(unsigned rows) {
    if (rows > kUsual) more_.resize(kEach * std::size_t{rows});
  }
  double* begin() { return more_.empty() ? usual_ : more_.data(); }

 private:
  // A robot needs at most 150 rows.
  static constexpr std::size_t kUsual = 256;
  double usual_[kEach * kUsual];
  std::vector<double> more_;
};

}  // namespace

std::span<const SolverLoops> solver_loops() {
  return std::span(kLoops).subspan(kFirst);
}

}  // namespace verp::sim

void verp_solve_lower(const double* l, double* b, unsigned n, unsigned skip) {
  verp::sim::solver_loops()[0].solve_lower(l, b, n, skip);
}

void verp_solve_upper(const double* l, double* b, unsigned n, unsigned skip) {
  verp::sim::Room<1> room(n);
  verp::sim::solver_loops()[0].solve_upper(l, b, n, skip, room.begin());
}

void verp_factor(double* a, double* d, unsigned n, unsigned skip) {
  verp::sim::Room<8> room(n);
  verp::sim::solver_loops()[0].factor(a, d, n, skip, room.begin());
}

#else

namespace verp::sim {
std::span<const SolverLoops> solver_loops() {
  return {};
}
}  // namespace verp::sim
#endif
