#include <gtest/gtest.h>

#include <cstdlib>
#include <span>
#include <string>

#include "common/control/step.hpp"
#include "host/boards/board/replay_on_target.hpp"
#include "tests/support/random_inputs.hpp"

namespace verp::board {
namespace {

std::string board() {
  const char* name = std::getenv("VERP_TEST_BOARD");
  return name != nullptr ? name : "VERP_TEST_BOARD is not set";
}

Params plain_robot() {
  Params params;
  params.joint_count = 21;
  for (JointParams& joint : params.joint) {
    joint.counts_per_rad = 651.9f;  // 4096 counts a turn
    joint.zero_count = 2048;
  }
  params.imu.gyro_rad_s_per_count = 0.001f;
  params.imu.accel_m_s2_per_count = 0.01f;
  return params;
}

TargetReplay replay_here(const Params& params, std::span<const Inputs> inputs,
                         const TargetReplayOptions& options = {}) {
  TargetReplay result;
  State state;
  Outputs outputs;
  for (const Inputs& each : inputs) {
    step(params, state, each, outputs);
    result.digests.push_back(state.digest);
    if (options.state_after == result.digests.size() - 1) result.state = state;
  }
  return result;
}

std::string image_of(const State& state) {
  return {reinterpret_cast<const char*>(&state), sizeof state};
}

void expect_same(const TargetReplay& here, const TargetReplay& there) {
  ASSERT_EQ(here.digests.size(), there.digests.size());
  for (std::size_t i = 0; i < here.digests.size(); ++i) {
    for (int stage = 0; stage < kStages; ++stage) {
      ASSERT_EQ(here.digests[i].stage[stage], there.digests[i].stage[stage])
          << "first divergence: tick " << i << ", stage " << kStageNames[stage];
    }
    ASSERT_EQ(here.digests[i].chain, there.digests[i].chain) << "tick " << i;
  }
}

TEST(TargetReplay, PlausibleInputsGiveTheSameDigests) {
  const Params params = plain_robot();
  const auto inputs = test::plausible_inputs(5000, 1, 981, params);
  expect_same(replay_here(params, inputs), replay_on(board(), params, inputs));
}

TEST(TargetReplay, AnyBitsGiveTheSameDigests) {
  const Params params = plain_robot();
  const auto inputs = test::wild_inputs(2000, 2);
  expect_same(replay_here(params, inputs), replay_on(board(), params, inputs));
}

TEST(TargetReplay, HandsBackTheStateAfterTheTickAskedFor) {
  const Params params = plain_robot();
  const auto inputs = test::plausible_inputs(300, 3, 981, params);
  const TargetReplayOptions options{.state_after = 256};
  const TargetReplay here = replay_here(params, inputs, options);
  const TargetReplay there = replay_on(board(), params, inputs, options);
  ASSERT_TRUE(here.state && there.state);
  EXPECT_EQ(image_of(*here.state), image_of(*there.state));
}

}  // namespace
}  // namespace verp::board
