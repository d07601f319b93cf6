#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "common/control/digest_state.hpp"
#include "common/control/step.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "tests/bench/leg_problem.hpp"
#include "tests/target/twin_run.hpp"

/// bench_core FOLDER [--benchmark_...]: times of the core on this PC, over target_bench's generic21
/// walk. Keeps it in FOLDER/inputs and writes FOLDER/leg for bench_peers.
namespace verp::bench {
namespace {

constexpr std::uint32_t kTicks = 3600;     // 36 s at 10 ms
constexpr std::uint32_t kFirstTick = 650;  // the robot is up
constexpr std::uint32_t kLastTick = 3250;
constexpr std::uint32_t kLegTargets = 512;  // five seconds, two kinds of walk

struct LegPose {
  Pose sole;
  float before_rad[kLegJoints];
};

struct Recording {
  Params params;
  std::vector<Inputs> walking;
  State start;  // at kFirstTick
  Outputs start_outputs;
  std::vector<LegPose> left_leg;
  float angle_rad[kMaxJoints] = {};  // in mid-walk
};

void read_goals(const Params& params, const Outputs& outputs, float* angle_rad) {
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    angle_rad[j] =
        (static_cast<float>(outputs.goal_count[j]) - joint.zero_count) / joint.counts_per_rad;
  }
}

LegPose leg_pose(const Params& params, const float* before_rad, const float* now_rad) {
  const LegParams& leg = params.leg[0];
  LegPose pose;
  float angle_rad[kLegJoints];
  for (int k = 0; k < kLegJoints; ++k) {
    pose.before_rad[k] = before_rad[leg.joint[k]];
    angle_rad[k] = now_rad[leg.joint[k]];
  }
  pose.sole = kinematics::sole_pose(leg, kinematics::leg_chain(params, leg, Pose{}, angle_rad));
  return pose;
}

/// From `file`, or else from the twin. Empty if the robot did not finish.
std::vector<Inputs> walk(const test::Robot& robot, const std::string& file) {
  std::vector<Inputs> inputs(kTicks);
  const auto size = static_cast<std::streamsize>(kTicks * sizeof(Inputs));
  if (std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(inputs.data()), size)) {
    return inputs;
  }
  const test::TwinRun run = test::run_here(robot, kTicks, true);
  if (run.fallen || run.records.size() != kTicks) return {};
  std::transform(run.records.begin(), run.records.end(), inputs.begin(),
                 [](const TickRecord& record) { return record.inputs; });
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(inputs.data()), size);
  return inputs;
}

bool record(const std::string& file, Recording& recording) {
  const test::Robot robot = test::load_robot("generic21");
  const std::vector<Inputs> inputs = walk(robot, file);
  if (inputs.empty()) return false;
  recording.params = robot.params;
  const auto state = std::make_unique<State>();
  Outputs outputs;
  float before_rad[kMaxJoints] = {};
  for (std::uint32_t tick = 0; tick < kLastTick; ++tick) {
    if (tick == kFirstTick) {
      recording.start = *state;
      recording.start_outputs = outputs;
    }
    if (tick >= kFirstTick) recording.walking.push_back(inputs[tick]);
    step(robot.params, *state, inputs[tick], outputs);
    read_goals(robot.params, outputs, recording.angle_rad);
    if (tick >= kFirstTick && tick < kFirstTick + kLegTargets) {
      recording.left_leg.push_back(leg_pose(robot.params, before_rad, recording.angle_rad));
    }
    std::copy_n(recording.angle_rad, kMaxJoints, before_rad);
  }
  return true;
}

template <class To, class From>
void copy_rows(const From& matrix, To& to) {
  for (int k = 0; k < 9; ++k) to[static_cast<std::size_t>(k)] = matrix(k / 3, k % 3);
}

template <class To>
void copy_vector(const Vec3& vector, To&& to) {
  for (int k = 0; k < 3; ++k) to[k] = vector(k);
}

LegProblem make_problem(const Recording& recording) {
  const Params& params = recording.params;
  const LegParams& leg = params.leg[0];
  LegProblem problem;
  for (int k = 0; k < kLegJoints; ++k) {
    const JointParams& joint = params.joint[leg.joint[k]];
    copy_vector(math::to_vec(joint.origin_parent_m), problem.origin_m.data() + 3 * k);
    copy_vector(math::to_vec(joint.axis), problem.axis.data() + 3 * k);
  }
  std::copy_n(leg.sole_foot, 9, problem.foot_sole.begin());
  copy_vector(math::to_vec(leg.sole_foot_m), problem.foot_sole_m.data());
  for (const LegPose& pose : recording.left_leg) {
    const auto solved = kinematics::solve_leg(params, leg, pose.sole, pose.before_rad);
    LegTarget& target = problem.targets.emplace_back();
    copy_rows(pose.sole.rotation, target.sole_rotation);
    copy_vector(pose.sole.position_m, target.sole_m.data());
    std::copy_n(pose.before_rad, kLegJoints, target.before_rad.begin());
    std::copy_n(solved.angle_rad, kLegJoints, target.answer_rad.begin());
  }
  return problem;
}

void time_tick(benchmark::State& timer, const Recording& recording) {
  State state = recording.start;
  Outputs outputs = recording.start_outputs;
  std::size_t tick = 0;
  for ([[maybe_unused]] auto _ : timer) {
    step(recording.params, state, recording.walking[tick], outputs);
    benchmark::DoNotOptimize(outputs);
    if (++tick < recording.walking.size()) continue;
    tick = 0;
    state = recording.start;
    outputs = recording.start_outputs;
  }
}

void time_digest(benchmark::State& timer, const Recording& recording) {
  State state = recording.start;
  for ([[maybe_unused]] auto _ : timer) {
    digest_state(recording.walking.front(), recording.start_outputs, state);
    benchmark::DoNotOptimize(state.digest);
  }
}

void time_leg_ik(benchmark::State& timer, const Recording& recording) {
  std::size_t n = 0;
  for ([[maybe_unused]] auto _ : timer) {
    const LegPose& pose = recording.left_leg[n];
    auto solved = kinematics::solve_leg(recording.params, recording.params.leg[0], pose.sole,
                                        pose.before_rad);
    benchmark::DoNotOptimize(solved);
    if (++n == recording.left_leg.size()) n = 0;
  }
}

void time_body_kinematics(benchmark::State& timer, const Recording& recording) {
  Pose node[kMaxNodes];
  for ([[maybe_unused]] auto _ : timer) {
    kinematics::all_poses(recording.params, Pose{}, recording.angle_rad, node);
    Vec3 com_m = kinematics::center_of_mass(recording.params, Pose{}, recording.angle_rad);
    benchmark::DoNotOptimize(node);
    benchmark::DoNotOptimize(com_m);
  }
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_core FOLDER [--benchmark_...]\n");
    return 2;
  }
  const auto recording = std::make_unique<Recording>();
  const std::string folder = argv[1];
  if (!record(folder + "/inputs", *recording)) {
    std::fprintf(stderr, "bench_core: generic21 did not walk to the end, so nothing was timed\n");
    return 1;
  }
  if (!write_problem(folder + "/leg", make_problem(*recording))) {
    std::fprintf(stderr, "bench_core: cannot write into %s; is there such a folder?\n", argv[1]);
    return 2;
  }
  const auto add = [&](const char* name, auto* time) {
    benchmark::RegisterBenchmark(
        name, [time, &recording](benchmark::State& timer) { time(timer, *recording); });
  };
  add("tick", time_tick);
  add("digest", time_digest);
  add("leg_ik", time_leg_ik);
  add("body_kinematics", time_body_kinematics);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace verp::bench

int main(int argc, char** argv) {
  try {
    return verp::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_core: %s\n", error.what());
    return 3;
  }
}
