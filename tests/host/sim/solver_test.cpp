#include "host/twin/sim/solver.hpp"

#include <gtest/gtest.h>

#if defined(__x86_64__)
#include <dlfcn.h>
#include <ode/ode.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "host/twin/sim/solver_lanes.hpp"

/// ODE calls our loops; they equal its own bit for bit.
namespace verp::sim {
namespace {

using Solve = void (*)(const double*, double*, unsigned, unsigned);
using Factor = void (*)(double*, double*, unsigned, unsigned);
constexpr const char* kSolveLower = "_Z15solveL1StraightILj1EEvPKdPdjj";
constexpr const char* kSolveUpper = "_Z17solveL1TransposedILj1EEvPKdPdjj";
constexpr const char* kFactor = "_Z18factorMatrixAsLDLTILj1EEvPdS0_jj";

void* own_of_ode(const char* name) {
  void* ode = dlopen("libode.so.8", RTLD_NOW | RTLD_NOLOAD);
  return ode == nullptr ? nullptr : dlsym(ode, name);
}

struct Equations {
  unsigned n = 0, skip = 0;
  std::vector<double> a, b;
};

/// Symmetric, diagonally dominant, with ODE's padding; garbage in the upper half.
Equations draw(unsigned n, std::mt19937& random) {
  std::normal_distribution<double> number;
  Equations drawn{n, n > 1 ? (n + 3) / 4 * 4 : 1, {}, {}};
  drawn.a.assign(n * drawn.skip, 1e300);
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < i; ++j) drawn.a[i * drawn.skip + j] = number(random);
    drawn.a[i * drawn.skip + i] = n + number(random);
    drawn.b.push_back(i % 7 == 3 ? -0.0 : number(random));
  }
  return drawn;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class Solver : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(own_of_ode(kSolveLower), nullptr) << "this ODE has other loops than 0.16's";
    ASSERT_NE(own_of_ode(kSolveUpper), nullptr);
    ASSERT_NE(own_of_ode(kFactor), nullptr);
  }
};

/// Like a robot's: rows and b begin with zeros of both signs.
void thin_out(Equations& of, std::mt19937& random) {
  const auto zeros = [&](unsigned count) {
    return std::uniform_int_distribution<unsigned>(0, count)(random);
  };
  for (unsigned i = 0; i < of.n; ++i) {
    double* row = &of.a[i * of.skip];
    std::fill_n(row, zeros(i), 0.0);
    for (unsigned some = 0; some < i / 4; ++some) row[zeros(i - 1)] = some % 3 == 0 ? -0.0 : 0.0;
  }
  std::fill_n(of.b.begin(), zeros(of.n), 0.0);
  if (of.n > 5) of.b[zeros(5)] = -0.0;
}

/// The program's, and the tests' own build, which sanitizers watch.
std::vector<SolverLoops> all_loops() {
  std::vector<SolverLoops> all(solver_loops().begin(), solver_loops().end());
  all.push_back({"in the test", lanes::solve_lower, lanes::solve_upper, lanes::factor});
  return all;
}

TEST_F(Solver, HasEachBitOfOdesOwn) {
  std::mt19937 random(1);
  const auto lower = reinterpret_cast<Solve>(own_of_ode(kSolveLower));
  const auto upper = reinterpret_cast<Solve>(own_of_ode(kSolveUpper));
  const auto factor = reinterpret_cast<Factor>(own_of_ode(kFactor));
  ASSERT_FALSE(solver_loops().empty());
  for (unsigned i = 0; i < 400; ++i) {
    const unsigned n = 1 + i / 2;
    Equations drawn = draw(n, random);
    if (i % 2 > 0) thin_out(drawn, random);
    std::vector<double> l = drawn.a, d(n), down = drawn.b, up = drawn.b;
    factor(l.data(), d.data(), n, drawn.skip);
    lower(l.data(), down.data(), n, drawn.skip);
    upper(l.data(), up.data(), n, drawn.skip);
    for (const SolverLoops& ours : all_loops()) {
      SCOPED_TRACE(std::string(ours.instructions) + ", " + std::to_string(n) + " rows");
      std::vector<double> our_l = drawn.a, our_d(n), our_down = drawn.b, our_up = drawn.b;
      std::vector<double> room(8 * std::size_t{n});
      ours.factor(our_l.data(), our_d.data(), n, drawn.skip, room.data());
      ours.solve_lower(our_l.data(), our_down.data(), n, drawn.skip);
      ours.solve_upper(our_l.data(), our_up.data(), n, drawn.skip, room.data());
      EXPECT_TRUE(same(our_l, l));
      EXPECT_TRUE(same(our_d, d));
      EXPECT_TRUE(same(our_down, down));
      EXPECT_TRUE(same(our_up, up));
    }
  }
}

TEST_F(Solver, IsWhatOdeCalls) {
  for (const char* name : {kSolveLower, kSolveUpper, kFactor}) {
    EXPECT_NE(dlsym(RTLD_DEFAULT, name), nullptr);
    EXPECT_NE(dlsym(RTLD_DEFAULT, name), own_of_ode(name)) << name << " is not taken from here";
  }
}

TEST_F(Solver, FactorsALargeMatrixToo) {
  std::mt19937 random(2);
  const Equations drawn = draw(411, random);
  std::vector<double> l = drawn.a, d(drawn.n), our_l = l, our_d = d;
  reinterpret_cast<Factor>(own_of_ode(kFactor))(l.data(), d.data(), drawn.n, drawn.skip);
  reinterpret_cast<Factor>(dlsym(RTLD_DEFAULT, kFactor))(our_l.data(), our_d.data(), drawn.n,
                                                         drawn.skip);
  EXPECT_TRUE(same(our_l, l));
  EXPECT_TRUE(same(our_d, d));
}

}  // namespace
}  // namespace verp::sim

#else

TEST(Solver, LeavesOdesOwnLoopsToOtherProcessors) {
  EXPECT_TRUE(verp::sim::solver_loops().empty());
}

#endif
