#include "common/control/step.hpp"

#include <gtest/gtest.h>

#include "common/model/tuning_ranges.hpp"
#include "tests/unit/control/loop.hpp"

namespace verp::control {
namespace {

using safety::Mode;
using test::kRobot;
using test::Loop;
using test::Random;

constexpr int kWildTicks = 2000;  // seconds on an emulated core

/// One for all tests: a small board has no RAM for more.
State& fresh_state() {
  static State state;
  state = State{};
  return state;
}

void expect_safe(const State& state, const Outputs& outputs, int tick) {
  ASSERT_TRUE(test::struct_is_finite(state)) << "tick " << tick;
  ASSERT_LT(int{outputs.mode}, safety::kModes);
  const bool torque = safety::has_torque(static_cast<Mode>(outputs.mode));
  ASSERT_EQ(outputs.torque_enable, torque ? (1u << test::kJointCount) - 1 : 0u);
  for (int j = 0; j < kRobot.joint_count; ++j) {
    const JointParams& joint = kRobot.joint[j];
    const std::int32_t a = model::count_of(joint, joint.lower_rad);
    const std::int32_t b = model::count_of(joint, joint.upper_rad);
    ASSERT_GE(outputs.goal_count[j], a < b ? a : b) << "tick " << tick << ", joint " << j;
    ASSERT_LE(outputs.goal_count[j], a < b ? b : a) << "tick " << tick << ", joint " << j;
  }
}

// Outputs are inside limits, never NaN.
void expect_total(bool fully, std::uint32_t seed) {
  State& state = fresh_state();
  Random random(seed);
  Inputs inputs;
  Outputs outputs;
  std::uint32_t modes = 0;
  for (int tick = 0; tick < kWildTicks; ++tick) {
    test::wild(random, fully, outputs, inputs);
    step(kRobot, state, inputs, outputs);
    expect_safe(state, outputs, tick);
    modes |= 1u << outputs.mode;
    for (int id = 0; id < kTuningCount; ++id) {
      ASSERT_TRUE(in_range(id, tuning_value(state.tuning, id))) << "parameter " << id;
    }
  }
  if (!fully) {
    EXPECT_NE(modes & 1u << static_cast<int>(Mode::kWalking), 0u) << "never walked";
  }
}

TEST(Step, IsTotalForAnyBits) {
  expect_total(true, 1);
}
TEST(Step, IsTotalForWildSensorsAndParametersOfAWalkingRobot) {
  expect_total(false, 2);
}

TEST(Step, GoalsKeepTheJointsSpeed) {
  Random random(3);
  Inputs inputs;
  Outputs outputs, before;
  State& state = fresh_state();
  for (int tick = 0; tick < kWildTicks / 2; ++tick) {
    test::wild(random, false, outputs, inputs);
    before = outputs;
    step(kRobot, state, inputs, outputs);
    if (tick == 0 || (before.torque_enable & outputs.torque_enable) == 0) continue;
    for (int j = 0; j < kRobot.joint_count; ++j) {
      const std::int32_t moved = outputs.goal_count[j] - before.goal_count[j];
      ASSERT_LE(moved < 0 ? -moved : moved, 54) << "8.06 rad/s x 10 ms x 652 counts, and rounding";
    }
  }
}

TEST(Step, NewtonLegsReachTheirStandFromTheFirstTickOn) {
  static const Params robot = test::make_hyperextended_robot();
  State& state = fresh_state();
  Inputs inputs;
  Outputs outputs;
  inputs.fresh = ~0u;
  for (int tick = 0; tick < 10; ++tick) {
    for (int j = 0; j < robot.joint_count; ++j) {
      inputs.position_count[j] = model::count_of(robot.joint[j], tick < 5 ? 0.0F : 0.4F);
    }
    step(robot, state, inputs, outputs);
    ++inputs.tick;
    ASSERT_EQ(outputs.faults & safety::kNoteLegLimited, 0u) << "tick " << tick;
  }
}

TEST(Step, IsTotalForAnEmptyRobot) {
  static const Params nothing;
  State& state = fresh_state();
  Random random(4);
  Inputs inputs;
  Outputs outputs;
  for (int tick = 0; tick < 300; ++tick) {
    test::wild(random, false, outputs, inputs);
    step(nothing, state, inputs, outputs);
    ASSERT_TRUE(test::struct_is_finite(state)) << "tick " << tick;
  }
}

TEST(Step, RisesWalksStopsAndSitsDown) {
  Loop& loop = test::fresh_loop();
  loop.ticks(5);
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed));
  loop.command.request = Request::kStand;
  EXPECT_GE(loop.until(Mode::kRising, 5), 0);
  EXPECT_GE(loop.until(Mode::kStanding, 150), 0);
  loop.walk(1777);
  EXPECT_GE(loop.until(Mode::kWalking, 400), 0) << "bias must be learnt first";
  loop.ticks(500);
  EXPECT_EQ(loop.outputs.gait_phase, static_cast<std::uint8_t>(gait::Phase::kTransition));
  EXPECT_EQ(loop.outputs.faults, 0u);
  loop.command.request = Request::kStand;
  EXPECT_GE(loop.until(Mode::kStanding, 400), 0);
  loop.command.request = Request::kRelax;
  EXPECT_GE(loop.until(Mode::kSitting, 5), 0);
  EXPECT_GE(loop.until(Mode::kRelaxed, 200), 0);
  for (int j = 0; j < kRobot.joint_count; ++j) {
    EXPECT_NEAR(model::angle_of(kRobot.joint[j], loop.inputs.position_count[j]),
                kRobot.joint[j].sit_rad, 2e-3F)
        << kRobot.joint[j].name;
  }
}

void get_walking(Loop& loop) {
  loop = Loop{};
  loop.walk(1000);
  ASSERT_GE(loop.until(Mode::kWalking, 600), 0);
  loop.ticks(200);
}

TEST(Step, ZeroErrorsReachTheGoalsUnlessSwitchedOff) {
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  const auto ankle_goals = [&](float zero_rad, float enable) {
    State state = loop.state;
    state.zeros.leg[0].pitch_rad = zero_rad;
    state.tuning.balance.zeros_enable = enable;
    Outputs outputs;
    step(kRobot, state, loop.inputs, outputs);
    return outputs.goal_count[kRobot.leg[0].joint[4]];
  };
  EXPECT_GT(ankle_goals(0.02F, 1), ankle_goals(0.0F, 1) + 10) << "0.02 rad are 13 counts";
  EXPECT_EQ(ankle_goals(0.02F, 0), ankle_goals(0.0F, 0));
}

TEST(Step, WhatWasLearntOfLandingsReachesTheGoalsUnlessSwitchedOff) {
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  const auto hip_goals = [&](float beyond, float enable) {
    State state = loop.state;
    state.landing.beyond = beyond;
    state.tuning.balance.zeros_enable = enable;
    Outputs outputs;
    step(kRobot, state, loop.inputs, outputs);
    return outputs.goal_count[kRobot.leg[0].joint[2]] + outputs.goal_count[kRobot.leg[1].joint[2]];
  };
  bool moved = false;
  for (int tick = 0; tick < 23; ++tick) {
    loop.ticks(1);
    moved = moved || std::abs(hip_goals(0.2F, 1) - hip_goals(0.0F, 1)) > 5;
    EXPECT_EQ(hip_goals(0.2F, 0), hip_goals(0.0F, 0));
  }
  EXPECT_TRUE(moved) << "in some tick of a step";
}

TEST(Step, SilentServoHoldsThenSits) {
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  loop.inputs.fresh = ~(1u << 12);
  const int held = loop.until(Mode::kHolding, 20);
  EXPECT_GE(held, 0);
  EXPECT_NE(loop.outputs.faults & safety::kFaultServoSilent, 0u);
  EXPECT_GE(loop.until(Mode::kSitting, 100), 0);
}

// Servo 12 is silent for 70 ms of each `every` ticks; how often the mode changes in a minute.
int changes_in_a_minute(int every, Loop& loop) {
  int changes = 0;
  for (int i = 0; i < 6000; ++i) {
    const std::uint8_t before = loop.outputs.mode;
    loop.inputs.fresh = i % every < 7 ? ~(1u << 12) : ~0u;
    loop.tick();
    changes += loop.outputs.mode != before ? 1 : 0;
  }
  loop.inputs.fresh = ~0u;
  return changes;
}

TEST(Step, RobotThatIsSilencedAgainAndAgainSitsDownUntilItIsRelaxed) {
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  EXPECT_LE(changes_in_a_minute(30, loop), 12) << "four times holding and rising, then it sits";
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed)) << "though a walk is asked all the time";
  EXPECT_NE(loop.outputs.faults & safety::kFaultFlutter, 0u);
  loop.command.request = Request::kRelax;
  loop.ticks(2);
  EXPECT_EQ(loop.outputs.faults, 0u) << "acknowledged";
  loop.command.request = Request::kWalk;
  EXPECT_GE(loop.until(Mode::kWalking, 600), 0) << "left by asking to relax";
}

// A cable that is touched: three times in ten seconds, for ever.
TEST(Step, RobotThatIsSilencedNowAndThenRisesEachTime) {
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  EXPECT_GE(changes_in_a_minute(334, loop), 18 * 3);
  EXPECT_EQ(loop.outputs.faults & safety::kFaultFlutter, 0u);
  EXPECT_NE(loop.outputs.torque_enable, 0u);
}

TEST(Step, QuietOperatorStopsTheWalkOnBothFeet) {
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  loop.inputs.flags = static_cast<std::uint16_t>(loop.inputs.flags & ~kCommandFresh);
  const GaitTuning& gait = kRobot.tuning.gait;
  const SafetyTuning& safety = kRobot.tuning.safety;
  const float most_s = safety.command_hold_s + 2.0F * gait.cycle_s + gait.start_s;
  EXPECT_GE(loop.until(Mode::kStanding, static_cast<int>(100.0F * most_s)), 0) << "four steps";
  EXPECT_NE(loop.outputs.faults & safety::kFaultOperatorQuiet, 0u);
  EXPECT_EQ(loop.outputs.stance, gait::kBoth);
}

TEST(Step, FallMakesItLimpAndIsLatchedUntilAcknowledged) {
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  loop.inputs.accel_count[0] = 8172;
  loop.inputs.accel_count[2] = 0;
  loop.inputs.gyro_count[1] = -3000;
  EXPECT_GE(loop.until(Mode::kFallen, 200), 0);
  EXPECT_EQ(loop.outputs.torque_enable, 0u);
  EXPECT_NE(loop.outputs.faults & safety::kFaultFall, 0u);
  loop.ticks(10);
  EXPECT_TRUE(loop.is_in(Mode::kFallen)) << "whatever the operator asks";
  loop.inputs.gyro_count[1] = 0;
  loop.inputs.accel_count[0] = 0;
  loop.inputs.accel_count[2] = 8172;
  loop.ticks(500);
  loop.command.request = Request::kRelax;
  loop.ticks(3);
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed));
  EXPECT_EQ(loop.outputs.faults & safety::kFaultFall, 0u) << "acknowledged";
}

void lie(int way, Loop& loop) {
  constexpr std::int16_t kWays[5][3] = {
      {8172, 0, 0}, {-8172, 0, 0}, {0, 8172, 0}, {0, -8172, 0}, {0, 300, -8166}};
  for (int axis = 0; axis < 3; ++axis) loop.inputs.accel_count[axis] = kWays[way][axis];
}

TEST(Step, RobotThatLiesDoesNotBeginToRise) {
  Loop& loop = test::fresh_loop();
  for (int way = 0; way < 5; ++way) {
    loop = Loop{};
    loop.command.request = Request::kStand;
    lie(way, loop);
    for (int i = 0; i < 200; ++i) {
      loop.tick();
      ASSERT_EQ(loop.outputs.torque_enable, 0u) << "way " << way << ", tick " << i;
    }
    loop.inputs.accel_count[0] = loop.inputs.accel_count[1] = 0;
    loop.inputs.accel_count[2] = 8172;
    EXPECT_GE(loop.until(Mode::kRising, 1000), 0) << "set on its feet, it rises";
  }
}

// Its tilt is from before the silence.
TEST(Step, RobotThatFellWhileItsImuWasSilentDoesNotRise) {
  Loop& loop = test::fresh_loop();
  loop.command.request = Request::kStand;
  ASSERT_GE(loop.until(Mode::kStanding, 200), 0);
  loop.inputs.flags = static_cast<std::uint16_t>(loop.inputs.flags & ~kImuFresh);
  ASSERT_GE(loop.until(Mode::kRelaxed, 400), 0);
  loop.inputs.flags |= kImuFresh;
  lie(1, loop);
  for (int i = 0; i < 200; ++i) {
    loop.tick();
    ASSERT_EQ(loop.outputs.torque_enable, 0u) << "tick " << i;
  }
}

// Putting the joint back by hand is enough.
TEST(Step, JointBeyondItsLimitsIsNotThrownBack) {
  Loop& loop = test::fresh_loop();
  for (int j = 0; j < test::kJointCount; ++j) {
    const JointParams& joint = kRobot.joint[j];
    loop = Loop{};
    loop.command.request = Request::kStand;
    const std::int32_t before = loop.inputs.position_count[j];
    loop.inputs.position_count[j] = model::count_of(joint, joint.upper_rad + 0.5F);
    for (int i = 0; i < 50; ++i) {
      loop.tick();
      ASSERT_EQ(loop.outputs.torque_enable, 0u) << joint.name << ", tick " << i;
    }
    EXPECT_NE(loop.outputs.faults & safety::kFaultJointBeyond, 0u) << joint.name;
    loop.inputs.position_count[j] = before;
    EXPECT_GE(loop.until(Mode::kRising, 3), 0) << "put back, it rises";
  }
}

void tick_with_sagging_supply(Loop& loop) {
  loop.inputs.flags |= kSlowFresh;
  loop.inputs.slow_joint =
      static_cast<std::uint8_t>((loop.inputs.slow_joint + 1) % test::kJointCount);
  loop.inputs.slow_voltage_tenth_v = loop.is_in(Mode::kWalking) ? 80 : 120;
  loop.inputs.slow_temperature_c = 40;
  loop.tick();
}

TEST(Step, SupplyThatSagsUnderLoadSitsTheRobotDownOnce) {
  Loop& loop = test::fresh_loop();
  loop.walk(1000);
  int changes = 0;
  std::uint8_t last = loop.outputs.mode;
  const auto minute = [&] {
    for (int i = 0; i < 6000; ++i) {
      tick_with_sagging_supply(loop);
      changes += loop.outputs.mode != last ? 1 : 0;
      last = loop.outputs.mode;
    }
  };
  minute();
  EXPECT_EQ(changes, 6) << "rising, standing, walking, standing, sitting, relaxed";
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed)) << "though a walk is asked all the time";
  EXPECT_NE(loop.outputs.faults & safety::kFaultVoltage, 0u);
  loop.command.request = Request::kRelax;
  loop.ticks(2);
  EXPECT_EQ(loop.outputs.faults, 0u) << "acknowledged";
  loop.command.request = Request::kWalk;
  loop.inputs.flags = static_cast<std::uint16_t>(loop.inputs.flags & ~kSlowFresh);
  EXPECT_GE(loop.until(Mode::kWalking, 600), 0) << "left by asking to relax";
}

TEST(Step, RobotWhosePowerIsBadDoesNotRise) {
  Loop& loop = test::fresh_loop();
  loop.inputs.flags |= kSlowFresh;
  loop.inputs.slow_voltage_tenth_v = 80;
  loop.inputs.slow_temperature_c = 40;
  loop.ticks(kSupplyReadings + 1);
  for (int i = 0; i < 100; ++i) {
    loop.command.request = i % 2 == 0 ? Request::kRelax : Request::kStand;
    loop.tick();
    ASSERT_EQ(loop.outputs.torque_enable, 0u);
  }
}

TEST(Step, RobotWaitsForEveryServosFirstReport) {
  Loop& loop = test::fresh_loop();
  for (int j = 0; j < test::kJointCount; ++j) {
    loop = Loop{};
    loop.command.request = Request::kStand;
    loop.inputs.fresh = ~(1u << j);
    loop.ticks(3);
    EXPECT_EQ(loop.outputs.torque_enable, 0u) << "joint " << j;
    loop.inputs.fresh = ~0u;
    EXPECT_EQ(loop.until(Mode::kRising, 3), 0) << "joint " << j;
  }
}

TEST(Step, EmergencyStopIsImmediate) {
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  loop.inputs.flags |= kEmergencyStop;
  loop.tick();
  EXPECT_TRUE(loop.is_in(Mode::kStopped));
  EXPECT_EQ(loop.outputs.torque_enable, 0u);
}

TEST(Step, ParametersOutOfRangeAreRefusedAndNoted) {
  Loop& loop = test::fresh_loop();
  loop.tick();
  const Tuning before = loop.state.tuning;
  for (const float bad : {test::quiet_nan(), test::infinity(), -1.0F, 99.0F}) {
    test::write_parameter(0, bad, loop.inputs);
    loop.tick();
    EXPECT_EQ(loop.state.tuning.gait.cycle_s, before.gait.cycle_s);
    EXPECT_NE(loop.outputs.faults & safety::kNoteParameter, 0u);
  }
  test::write_parameter(kTuningCount, 0.5F, loop.inputs);
  loop.tick();
  EXPECT_EQ(__builtin_memcmp(&loop.state.tuning, &before, sizeof before), 0);
  test::write_parameter(0, 0.6F, loop.inputs);
  loop.tick();
  EXPECT_EQ(loop.state.tuning.gait.cycle_s, 0.6F);
}

TEST(Step, TurnsTheHeadWhereToldWithinLimits) {
  Loop& loop = test::fresh_loop();
  loop.command.request = Request::kStand;
  loop.command.head_pan_mrad = 500;
  loop.command.head_tilt_mrad = -32768;
  loop.ticks(300);
  EXPECT_NEAR(loop.state.limit.goal_rad[test::kHead], 0.5F, 1e-3F);
  EXPECT_EQ(loop.state.limit.goal_rad[test::kHead + 1], kRobot.joint[test::kHead + 1].lower_rad);
}

// The right leg mirrors the left one half a cycle later. A cycle is 44 ticks; without heading
// control all steps last equally long.
TEST(Step, WalkIsPeriodic) {
  constexpr int kCycle = 44;
  constexpr float kMirror[kLegJoints] = {-1, -1, 1, 1, 1, -1};
  Loop& loop = test::fresh_loop();
  get_walking(loop);
  test::write_parameter(0, 0.44F, loop.inputs);
  loop.tick();
  test::write_parameter(16, 0.0F, loop.inputs);  // gait.heading_gain
  loop.tick();
  test::write_parameter(kTuningCount - 1, 3600.0F, loop.inputs);  // safety.unloaded_s
  loop.tick();
  loop.inputs.flags = kImuFresh | kFeetFresh | kCommandFresh;
  loop.ticks(20 * kCycle);
  static float goal_rad[2 * kCycle][test::kJointCount];
  for (auto& row : goal_rad) {
    loop.tick();
    for (int j = 0; j < test::kJointCount; ++j) row[j] = loop.state.limit.goal_rad[j];
  }
  float least_rad = 9, most_rad = -9;
  for (int i = 0; i < kCycle; ++i) {
    for (int j = 0; j < test::kJointCount; ++j) {
      EXPECT_NEAR(goal_rad[i + kCycle][j], goal_rad[i][j], 2e-3F)
          << kRobot.joint[j].name << " " << i;
    }
    for (int k = 0; k < kLegJoints; ++k) {
      const float right_rad = goal_rad[i + kCycle / 2][test::kRightLeg + k];
      EXPECT_NEAR(right_rad, kMirror[k] * goal_rad[i][test::kLeftLeg + k], 2e-3F) << k << " " << i;
    }
    const float knee_rad = goal_rad[i][test::kLeftLeg + 3];
    least_rad = knee_rad < least_rad ? knee_rad : least_rad;
    most_rad = knee_rad > most_rad ? knee_rad : most_rad;
  }
  EXPECT_GT(most_rad - least_rad, 0.1F) << "it walks";
}

}  // namespace
}  // namespace verp::control
