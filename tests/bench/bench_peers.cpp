#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainiksolverpos_nr.hpp>
#include <kdl/chainiksolvervel_wdls.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/leg_problem.hpp"

/// bench_peers FOLDER [--benchmark_...]: KDL's inverse kinematics on bench_core's leg, by the
/// faster of two solvers: Levenberg-Marquardt, and Newton-Raphson with weighted damped least
/// squares. Exit 1 if either differs from our answer.
///
/// KDL gets every advantage: set up once, single-axis joints, Eigen with the compiler's vectors, a
/// start at the true answer of 10 ms earlier, no joint limits. Tolerances are no finer than needed:
/// 1e-5 in m and rad, for Levenberg-Marquardt with a radian as 0.01 m.
namespace verp::bench {
namespace {

// KDL's tolerance: 1e-5 m is 1e-3 rad at a weight of 0.01 m.
constexpr double kMostApart_rad = 5e-3;
constexpr double kMostApart_m = 1e-4;

constexpr double kNewtonEnds = 1e-5;
constexpr unsigned kMostIterations = 100;

struct CountingWdls : KDL::ChainIkSolverVel_wdls {
  using ChainIkSolverVel_wdls::CartToJnt;
  using ChainIkSolverVel_wdls::ChainIkSolverVel_wdls;
  int CartToJnt(const KDL::JntArray& at, const KDL::Twist& by, KDL::JntArray& rate) override {
    ++calls;
    return ChainIkSolverVel_wdls::CartToJnt(at, by, rate);
  }
  double calls = 0;
};

struct Question {
  KDL::Frame sole;
  KDL::JntArray start{kJoints};
};

KDL::Vector vector_at(const double* xyz) {
  return {xyz[0], xyz[1], xyz[2]};
}

KDL::Rotation rotation_of(const std::array<double, 9>& m) {
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
}

KDL::Joint joint_about(const KDL::Vector& axis) {
  constexpr KDL::Joint::JointType kAlong[] = {KDL::Joint::RotX, KDL::Joint::RotY, KDL::Joint::RotZ};
  for (int k = 0; k < 3; ++k) {
    if (std::abs(axis(k)) > 1 - 1e-9) return KDL::Joint(kAlong[k], axis(k) < 0 ? -1.0 : 1.0);
  }
  return {KDL::Vector::Zero(), axis, KDL::Joint::RotAxis};
}

KDL::Chain make_chain(const LegProblem& leg) {
  KDL::Chain chain;
  chain.addSegment(
      KDL::Segment(KDL::Joint(KDL::Joint::None), KDL::Frame(vector_at(leg.origin_m.data()))));
  for (unsigned k = 0; k < kJoints; ++k) {
    const KDL::Frame next =
        k + 1 < kJoints ? KDL::Frame(vector_at(leg.origin_m.data() + 3 * (k + 1)))
                        : KDL::Frame(rotation_of(leg.foot_sole), vector_at(leg.foot_sole_m.data()));
    chain.addSegment(KDL::Segment(joint_about(vector_at(leg.axis.data() + 3 * k)), next));
  }
  return chain;
}

std::vector<Question> make_questions(const LegProblem& leg) {
  std::vector<Question> questions;
  for (const LegTarget& target : leg.targets) {
    Question& question = questions.emplace_back();
    question.sole = {rotation_of(target.sole_rotation), vector_at(target.sole_m.data())};
    for (unsigned k = 0; k < kJoints; ++k) question.start(k) = target.before_rad[k];
  }
  return questions;
}

struct Agreement {
  double apart_rad = 0, apart_m = 0, iterations = 0, seconds = 0;
  int unsolved = 0;
};

/// `iterations` counts those of all calls, if known.
struct Peer {
  const char* name;
  KDL::ChainIkSolverPos& solver;
  std::function<double()> iterations;
};

Agreement compare(const LegProblem& leg, const KDL::Chain& chain,
                  const std::vector<Question>& questions, const Peer& peer) {
  Agreement agreement;
  KDL::JntArray found(kJoints);
  KDL::ChainFkSolverPos_recursive forward(chain);
  KDL::Frame sole;
  for (std::size_t n = 0; n < questions.size(); ++n) {
    const auto begin = std::chrono::steady_clock::now();
    const int error = peer.solver.CartToJnt(questions[n].start, questions[n].sole, found);
    agreement.seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (error < 0) ++agreement.unsolved;
    for (unsigned k = 0; k < kJoints; ++k) {
      agreement.apart_rad =
          std::max(agreement.apart_rad, std::abs(found(k) - leg.targets[n].answer_rad[k]));
    }
    forward.JntToCart(found, sole);
    agreement.apart_m = std::max(agreement.apart_m, (sole.p - questions[n].sole.p).Norm());
    agreement.iterations += peer.iterations() / static_cast<double>(questions.size());
  }
  return agreement;
}

bool is_good(const Agreement& agreement, const Peer& peer) {
  if (agreement.unsolved == 0 && agreement.apart_rad <= kMostApart_rad &&
      agreement.apart_m <= kMostApart_m) {
    return true;
  }
  std::fprintf(
      stderr,
      "bench_peers: KDL's %s and ours disagree by %g rad (at most %g), %g m (at most %g), %d "
      "targets not solved by KDL\n",
      peer.name, agreement.apart_rad, kMostApart_rad, agreement.apart_m, kMostApart_m,
      agreement.unsolved);
  return false;
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  LegProblem leg;
  if (argc != 2 || !read_problem(std::string(argv[1]) + "/leg", leg)) {
    std::fprintf(stderr,
                 "usage: bench_peers FOLDER, in which bench_core has left its file `leg`\n");
    return 2;
  }
  const KDL::Chain chain = make_chain(leg);
  KDL::ChainIkSolverPos_LMA lma(chain);
  KDL::ChainFkSolverPos_recursive forward(chain);
  CountingWdls wdls(chain);
  KDL::ChainIkSolverPos_NR newton(chain, forward, wdls, kMostIterations, kNewtonEnds);
  const Peer peers[] = {{"LMA", lma, [&] { return lma.lastNrOfIter; }},
                        {"NR with WDLS", newton, [&] { return std::exchange(wdls.calls, 0); }}};
  const std::vector<Question> questions = make_questions(leg);
  const Agreement agreements[] = {compare(leg, chain, questions, peers[0]),
                                  compare(leg, chain, questions, peers[1])};
  const bool second = agreements[1].seconds < agreements[0].seconds;
  const Agreement& agreement = agreements[second];
  KDL::ChainIkSolverPos& solver = peers[second].solver;
  benchmark::RegisterBenchmark("kdl_leg_ik", [&](benchmark::State& timer) {
    KDL::JntArray found(kJoints);
    std::size_t n = 0;
    for ([[maybe_unused]] auto _ : timer) {
      solver.CartToJnt(questions[n].start, questions[n].sole, found);
      benchmark::DoNotOptimize(found.data.data());
      if (++n == questions.size()) n = 0;
    }
    timer.counters["is_newton"] = second;
    timer.counters["apart_rad"] = agreement.apart_rad;
    timer.counters["apart_m"] = agreement.apart_m;
    timer.counters["iterations"] = agreement.iterations;
    timer.counters["targets"] = static_cast<double>(questions.size());
  });
  benchmark::RunSpecifiedBenchmarks();
  return is_good(agreements[0], peers[0]) && is_good(agreements[1], peers[1]) ? 0 : 1;
}

}  // namespace
}  // namespace verp::bench

int main(int argc, char** argv) {
  return verp::bench::run(argc, argv);
}
