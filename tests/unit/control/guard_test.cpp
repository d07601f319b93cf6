#include "common/control/guard.hpp"

#include <gtest/gtest.h>

#include "common/math/scalar.hpp"
#include "common/model/counts.hpp"
#include "common/safety/machine.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::control {
namespace {

using safety::Mode;
using namespace verp::test;

constexpr int kJoint = kLeftArm;

/// A robot with torque whose core wants 0 rad everywhere.
struct Rig {
  Rig() {
    core.torque_enable = sent.torque_enable = asked.torque_enable = (1U << kJointCount) - 1;
    for (int j = 0; j < kJointCount; ++j)
      core.goal_count[j] = sent.goal_count[j] = asked.goal_count[j] = inputs.position_count[j] =
          count(j, middle(j));
  }
  static float middle(int j) {
    return 0.5F * (kRobot.joint[j].lower_rad + kRobot.joint[j].upper_rad);
  }
  static std::int32_t count(int j, float rad) { return model::count_of(kRobot.joint[j], rad); }
  /// More than a joint moves in one tick, in its range.
  static std::int32_t far(int j) { return count(j, kRobot.joint[j].upper_rad); }
  int tick(Mode mode) {
    core.mode = static_cast<std::uint8_t>(mode);
    Outputs next = asked;
    const int refused = guard(kRobot, inputs, sent, core, next);
    sent = next;
    return refused;
  }

  Inputs inputs;
  Outputs sent, core, asked;
};

bool heard(Mode mode) {
  return mode == Mode::kStanding || mode == Mode::kWalking;
}

TEST(Guard, SendsTorqueOnlyWhereTheCoreHasItAndTheOtherLeavesIt) {
  for (int mode = 0; mode < safety::kModes; ++mode) {
    Rig rig;
    rig.core.torque_enable = 0b0011;
    rig.asked.torque_enable = 0b0101;
    rig.tick(static_cast<Mode>(mode));
    EXPECT_EQ(rig.sent.torque_enable, 0b0001U) << safety::kModeNames[mode];
  }
}

TEST(Guard, SendsTheOthersGoalsOnlyWhereTheRobotStandsOrWalks) {
  for (int mode = 0; mode < safety::kModes; ++mode) {
    Rig rig;
    const std::int32_t before = rig.sent.goal_count[kJoint];
    rig.asked.goal_count[kJoint] = Rig::far(kJoint);
    rig.tick(static_cast<Mode>(mode));
    EXPECT_EQ(rig.sent.goal_count[kJoint] != before, heard(static_cast<Mode>(mode)))
        << safety::kModeNames[mode];
  }
}

TEST(Guard, JudgesNoGoalOfALimpJoint) {
  for (const bool core : {false, true}) {
    Rig rig;
    (core ? rig.core : rig.asked).torque_enable &= ~(1U << kJoint);
    rig.core.goal_count[kJoint] += 7;
    rig.asked.goal_count[kJoint] = 1'000'000;
    EXPECT_EQ(rig.tick(Mode::kStanding), int{kMaxJoints}) << "none is refused";
    EXPECT_EQ(rig.sent.goal_count[kJoint], rig.core.goal_count[kJoint]);
  }
}

TEST(Guard, SaysWhatTheCoreSaysOfModeAndFaults) {
  Rig rig;
  rig.core.faults = safety::kFaultVoltage;
  rig.asked.faults = 0;
  rig.asked.mode = static_cast<std::uint8_t>(Mode::kStanding);
  rig.tick(Mode::kSitting);
  EXPECT_EQ(rig.sent.faults, safety::kFaultVoltage);
  EXPECT_EQ(rig.sent.mode, static_cast<std::uint8_t>(Mode::kSitting));
}

TEST(Guard, MovesNoJointFasterThanItMay) {
  Rig rig;
  Random random(1);
  const float period_s = 1e-6F * static_cast<float>(kRobot.period_us);
  for (int tick = 0; tick < 1000; ++tick) {
    const Outputs before = rig.sent;
    for (int j = 0; j < kJointCount; ++j) {
      const JointParams& joint = kRobot.joint[j];
      rig.asked.goal_count[j] = Rig::count(j, random.between(joint.lower_rad, joint.upper_rad));
    }
    rig.tick(random.below(2) == 0 ? Mode::kWalking : Mode::kSitting);
    for (int j = 0; j < kJointCount; ++j) {
      const float most = kRobot.joint[j].velocity_limit_rad_s * period_s;
      const auto counts =
          static_cast<std::int32_t>(math::abs(kRobot.joint[j].counts_per_rad) * most) + 1;
      const std::int32_t way = rig.sent.goal_count[j] - before.goal_count[j];
      ASSERT_LE(way < 0 ? -way : way, counts) << "joint " << j;
    }
  }
}

TEST(Guard, ArrivesWhereTheOtherWantsIt) {
  Rig rig;
  rig.asked.goal_count[kJoint] = Rig::far(kJoint);
  for (int tick = 0; tick < 200; ++tick) EXPECT_EQ(rig.tick(Mode::kStanding), kMaxJoints);
  EXPECT_EQ(rig.sent.goal_count[kJoint], Rig::far(kJoint));
}

// Its last goal may be anywhere.
TEST(Guard, MovesAJointThatGetsTorqueFromWhereItIs) {
  Rig rig;
  rig.sent.torque_enable = 0;
  rig.sent.goal_count[kJoint] = Rig::far(kJoint);
  rig.asked.goal_count[kJoint] = Rig::far(kJoint);
  const float at_rad = Rig::middle(kJoint);
  rig.tick(Mode::kStanding);
  const float goal_rad = model::angle_of(kRobot.joint[kJoint], rig.sent.goal_count[kJoint]);
  EXPECT_NEAR(goal_rad, at_rad, 0.1F);
}

TEST(Guard, HoldsWhatWasSentWhileADeviceIsSilent) {
  Rig rig;
  rig.asked.goal_count[kJoint] = Rig::far(kJoint);
  for (int tick = 0; tick < 200; ++tick) rig.tick(Mode::kWalking);
  rig.tick(Mode::kHolding);
  EXPECT_EQ(rig.sent.goal_count[kJoint], Rig::far(kJoint)) << "the core would go back to 0";
}

TEST(Guard, RefusesAGoalOutOfRangeAndKeepsTheOneBefore) {
  const float beyond_rad = kRobot.joint[kJoint].upper_rad + 0.5F;
  for (const std::int32_t goal :
       {std::int32_t{INT32_MIN}, std::int32_t{100'000}, Rig::count(kJoint, beyond_rad)}) {
    Rig rig;
    const std::int32_t before = rig.sent.goal_count[kJoint];
    rig.asked.goal_count[kJoint] = goal;
    EXPECT_EQ(rig.tick(Mode::kWalking), kJoint);
    EXPECT_EQ(rig.sent.goal_count[kJoint], before);
    rig.sent.torque_enable = 0;
    EXPECT_EQ(rig.tick(Mode::kWalking), kJoint);
    EXPECT_EQ(rig.sent.torque_enable >> kJoint & 1U, 0U) << "limp, it stays limp";
  }
}

}  // namespace
}  // namespace verp::control
