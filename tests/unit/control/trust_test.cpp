#include <gtest/gtest.h>

#include <bit>

#include "tests/unit/control/loop.hpp"

namespace verp::control {
namespace {

using namespace test;

constexpr int kKneeJoint = kLeftLeg + 3;

Loop& far_walking() {
  Loop& loop = fresh_loop();
  loop.walk(1778);
  EXPECT_GE(loop.until(Mode::kWalking, 600), 0);
  loop.ticks(300);  // as fast as asked
  return loop;
}

/// Ticks until the robot holds while joint j reports `count`; -1: it does not.
int until_held(Loop& loop, int j, std::int32_t count, int most) {
  for (int i = 0; i < most; ++i) {
    loop.inputs.position_count[j] = count;
    loop.tick();
    if (loop.is_in(Mode::kHolding)) return i;
  }
  return -1;
}

// A stance knee hardly moves: its swing shows.
TEST(Trust, LegJointThatStaysHoldsTheWalkInItsNextSwing) {
  for (const int j : {kLeftLeg + 2, kKneeJoint, kLeftLeg + 4, kRightLeg + 2, kRightLeg + 3}) {
    for (int moment = 0; moment < 45; moment += 5) {
      Loop& loop = far_walking();
      loop.ticks(moment);
      const int held = until_held(loop, j, loop.inputs.position_count[j], 100);
      EXPECT_GE(held, 5) << kRobot.joint[j].name;
      EXPECT_LE(held, 45) << kRobot.joint[j].name << " from tick " << moment;
      EXPECT_EQ(loop.outputs.faults & 0xFFFFU, safety::kFaultNotFollowing + 0U);
      EXPECT_EQ(loop.state.machine.silent, 1U << j) << "it is named";
    }
  }
}

TEST(Trust, AngleThatJumpsByATurnHoldsTheWalkAtOnceThenSits) {
  Loop& loop = far_walking();
  const int held = until_held(loop, kKneeJoint, loop.inputs.position_count[kKneeJoint] + 4096, 10);
  EXPECT_GE(held, 0);
  EXPECT_LE(held, 5) << "stale_hold_s";
  EXPECT_GE(loop.until(Mode::kSitting, 5), 0) << "the reading is right again; its fault is latched";
}

TEST(Trust, JointThatIsStuckForGoodMakesTheRobotSitAndLetGo) {
  Loop& loop = far_walking();
  const std::int32_t stuck = loop.inputs.position_count[kKneeJoint];
  int ticks = 0;
  while (loop.outputs.torque_enable != 0 && ticks < 1000) {
    until_held(loop, kKneeJoint, stuck, 1);
    ++ticks;
  }
  EXPECT_LT(ticks, 400);
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed));
}

// Another joint is doubted in one tick of that silence: too short for a fault of its own.
TEST(Trust, SilentServoIsNoJointThatDoesNotFollow) {
  Loop& loop = far_walking();
  for (int i = 0; i < 6; ++i) {
    loop.inputs.fresh = ~(1U << 5);
    if (i == 5) loop.inputs.position_count[kKneeJoint] += 4096;
    loop.tick();
  }
  EXPECT_EQ(loop.outputs.faults & 0xFFFFU, safety::kFaultServoSilent + 0U);
}

// Servos that lag by three ticks, with play, and noise of a count.
TEST(Trust, LagAndPlayOfGoodServosRaiseNothing) {
  Loop& loop = far_walking();
  constexpr int kLag = 3;
  static std::int32_t goals[kLag][kJointCount];
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    for (int j = 0; j < kJointCount; ++j) {
      const std::int32_t late = i < kLag ? loop.inputs.position_count[j] : goals[i % kLag][j];
      goals[i % kLag][j] = loop.outputs.goal_count[j];
      const std::int32_t play = 4 * (j % 3) - 4;
      loop.inputs.position_count[j] = late + play + random.below(3) - 1;
    }
    loop.tick();
    ASSERT_TRUE(loop.is_in(Mode::kWalking)) << i << ", " << loop.outputs.faults;
    ASSERT_EQ(loop.state.trust.doubted, 0U);
  }
}

TEST(Trust, LimpJointsAreNeverDoubted) {
  Loop& loop = fresh_loop();
  for (int i = 0; i < 200; ++i) {
    loop.inputs.position_count[kKneeJoint] += 40;
    loop.tick();
    EXPECT_EQ(loop.state.trust.doubted, 0U);
  }
}

/// Axes 0 to 5: gyro, accelerometer. Those in `mask` stay; until the robot holds.
int until_imu_is_doubted(Loop& loop, unsigned mask, int flicker_axis) {
  const Inputs before = loop.inputs;
  for (int i = 0; i < 100; ++i) {
    for (int axis = 0; axis < 6; ++axis) {
      std::int16_t& count =
          axis < 3 ? loop.inputs.gyro_count[axis] : loop.inputs.accel_count[axis - 3];
      const std::int16_t old = axis < 3 ? before.gyro_count[axis] : before.accel_count[axis - 3];
      if ((mask >> axis & 1U) != 0) count = old;
      if (axis == flicker_axis && i % 2 != 0) count = static_cast<std::int16_t>(count ^ 64);
    }
    loop.tick();
    if (loop.is_in(Mode::kHolding)) return i;
  }
  return -1;
}

TEST(Trust, ImuOfWhichOnlyOneBitFlickersEndsTheWalk) {
  for (int axis = 0; axis < 6; ++axis) {
    Loop& loop = far_walking();
    const int held = until_imu_is_doubted(loop, 0x3F, axis);
    EXPECT_GE(held, 0) << axis;
    EXPECT_LE(held, 2 * safety::kImuReadings + 6);
    EXPECT_NE(loop.outputs.faults & safety::kFaultImuSilent, 0U);
    EXPECT_GE(loop.until(Mode::kRising, 100), 0) << "it moves again";
  }
}

TEST(Trust, GyroOrAccelerometerThatIsStuckAloneEndsTheWalk) {
  for (const unsigned mask : {0x07U, 0x38U}) {
    Loop& loop = far_walking();
    const int held = until_imu_is_doubted(loop, mask, -1);
    EXPECT_GE(held, 0);
    EXPECT_LE(held, 2 * safety::kImuReadings + 6);
  }
}

TEST(Trust, RobotWithoutAnImuWalksOnItsAssumedOne) {
  Loop& loop = far_walking();
  loop.noise = false;
  loop.inputs.flags |= kImuAssumed;
  loop.ticks(300);
  EXPECT_TRUE(loop.is_in(Mode::kWalking));
}

/// Their cells report no load; until then they did not report.
void empty_soles(Loop& loop) {
  loop.inputs.flags |= kFeetFresh;
}

TEST(Trust, RobotWhoseFeetCarryNothingSitsAndStaysDown) {
  for (const bool walks : {true, false}) {
    Loop& loop = far_walking();
    if (!walks) loop.command.request = Request::kStand;
    ASSERT_TRUE(walks || loop.until(Mode::kStanding, 300) >= 0);
    empty_soles(loop);
    const int sits = loop.until(Mode::kSitting, 600);
    EXPECT_GE(sits, 100) << "unloaded_s";
    EXPECT_LE(sits, 400) << "and the end of a walk";
    EXPECT_NE(loop.outputs.faults & safety::kFaultUnloaded, 0U);
    EXPECT_GE(loop.until(Mode::kRelaxed, 300), 0);
    loop.ticks(300);
    EXPECT_TRUE(loop.is_in(Mode::kRelaxed)) << "though it is asked to stand";
  }
}

TEST(Trust, SolesOrKneesThatBearTheWeightAreEnough) {
  Loop& loop = far_walking();
  empty_soles(loop);
  for (int i = 0; i < 500; ++i) {
    for (const int leg : {kLeftLeg, kRightLeg}) {  // the knees sag by 40 mrad
      const JointParams& knee = kRobot.joint[leg + 3];
      loop.inputs.position_count[leg + 3] += math::to_int32(0.04F * knee.counts_per_rad);
    }
    loop.tick();
  }
  EXPECT_TRUE(loop.is_in(Mode::kWalking)) << loop.outputs.faults;
}

TEST(Trust, RobotThatHangsWalksOnIfItsTuningSaysSo) {
  Loop& loop = far_walking();
  constexpr int kUnloaded = kTuningCount - 1;
  write_parameter(kUnloaded, 3600.0F, loop.inputs);
  empty_soles(loop);
  loop.ticks(500);
  EXPECT_TRUE(loop.is_in(Mode::kWalking));
  EXPECT_EQ(loop.outputs.faults, 0U);
}

// Its integral part holds the goal whatever the load.
TEST(Trust, ServoWithAnIGainShowsNoLoad) {
  Params& params = changed_robot();
  params.feet = {};
  constexpr float kSag_rad[kFeet] = {0.02F, 0.02F};
  float goal_rad[kMaxJoints] = {};
  Inputs inputs;
  for (int j = 0; j < kJointCount; ++j) {
    inputs.position_count[j] = model::count_of(params.joint[j], 0.0F);
  }
  for (const bool integral : {false, true}) {
    params.servo[0].position_i_gain = integral ? 10 : 0;
    safety::TrustState trust;
    bool nothing = false;
    for (int i = 0; i < 300; ++i) {
      nothing = safety::carries_nothing(params, inputs, {Mode::kStanding, false, goal_rad},
                                        kSag_rad, 1.0F, trust);
    }
    EXPECT_EQ(nothing, !integral);
  }
}

TEST(Trust, AnotherControllersGoalsAreNotTheCores) {
  Loop& loop = far_walking();
  loop.state.trust.foreign = 1;
  const std::int32_t stays = loop.inputs.position_count[kKneeJoint];
  EXPECT_EQ(until_held(loop, kKneeJoint, stays, 100), -1);
}

TEST(Trust, CellsThatFeelAFifthOfTheWeightBearTheRobot) {
  Params& params = changed_robot();
  double mass_kg = params.body_mass_kg;
  for (JointParams& joint : params.joint) {
    joint.compliance_rad_nm = 0;  // no knee shows a load
    mass_kg += joint.mass_kg;
  }
  const float none_rad[kMaxJoints] = {};
  for (int percent = 0; percent <= 100; ++percent) {
    if (percent == 20) continue;  // a rounding decides
    Inputs inputs;
    inputs.flags = kFeetFresh;
    const double load_n = 0.01 * percent * mass_kg * 9.80665;
    std::uint16_t& cell = inputs.foot_count[percent / 4 % 2][percent % 4];
    cell = static_cast<std::uint16_t>(load_n / double{params.feet.newton_per_count});
    safety::TrustState trust;
    const safety::Deed stands{Mode::kStanding, false, none_rad};
    int ticks = 1;  // of 10 ms
    while (ticks < 200 && !safety::carries_nothing(params, inputs, stands, none_rad, 0.5F, trust)) {
      ++ticks;
    }
    EXPECT_NEAR(ticks, percent < 20 ? 51 : 200, 1) << percent;
  }
}

/// An IMU whose axes in `mask` move by five counts, the others by four; true if doubted.
bool doubts_imu(safety::TrustState& trust, unsigned mask, bool stepping, unsigned more_flags = 0) {
  static const Params jointless;
  Inputs inputs;
  inputs.flags = static_cast<std::uint16_t>(kImuFresh | more_flags);
  bool doubted = false;
  for (int i = 0; i < safety::kImuReadings; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto moved = [&](unsigned bit) {
        return i % 2 == 0 ? 0 : (mask >> bit & 1U) != 0 ? 5 : 4;
      };
      const auto bit = static_cast<unsigned>(axis);
      inputs.gyro_count[axis] = static_cast<std::int16_t>(1000 * axis - 2500 + moved(bit));
      inputs.accel_count[axis] = static_cast<std::int16_t>(1000 * axis + 500 + moved(bit + 3));
    }
    doubted = safety::doubt(jointless, inputs, {Mode::kWalking, stepping, nullptr}, trust).imu;
  }
  return doubted;
}

TEST(Trust, ImuIsBelievedIfTwoAxesOfEachSensorMove) {
  for (unsigned mask = 0; mask < 64; ++mask) {
    const bool moves = std::popcount(mask & 7U) >= 2 && std::popcount(mask >> 3) >= 2;
    safety::TrustState trust;
    EXPECT_FALSE(doubts_imu(trust, mask, false)) << "only steps must move it";
    EXPECT_FALSE(doubts_imu(trust, mask, true, kImuAssumed));
    EXPECT_EQ(doubts_imu(trust, mask, true), !moves) << mask;
    EXPECT_EQ(doubts_imu(trust, mask, false), !moves) << "until it moves";
    EXPECT_FALSE(doubts_imu(trust, 63, false));
    trust.foreign = 1;
    EXPECT_FALSE(doubts_imu(trust, mask, true));
  }
}

}  // namespace
}  // namespace verp::control
