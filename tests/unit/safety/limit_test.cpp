#include "common/safety/limit.hpp"

#include <gtest/gtest.h>

#include "common/model/counts.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::safety {
namespace {

using test::kRobot;

constexpr std::int32_t kPeriod_us = 10000;
constexpr float kMost_rad = 8.06F * 0.01F;
constexpr Mode kTorqueModes[] = {Mode::kRising, Mode::kStanding, Mode::kWalking, Mode::kHolding,
                                 Mode::kSitting};

struct Joints {
  float wanted_rad[kMaxJoints] = {};
  std::int32_t position_count[kMaxJoints] = {};
  SafetyTuning tuning;
  LimitState state;
  std::uint16_t way_ms = 0;

  LimitOut run(Mode mode, std::int32_t in_mode_us, const Params& robot = kRobot) {
    const LimitOut out =
        limit(robot, state, {mode, in_mode_us, way_ms, wanted_rad, position_count, &tuning});
    way_ms = out.way_ms;
    return out;
  }
};

TEST(Limit, GoalsStayInsideLimitsAndSpeeds) {
  test::Random random(1);
  Joints joints;
  joints.run(Mode::kRelaxed, 0);
  for (int i = 0; i < 1000; ++i) {
    for (int j = 0; j < kRobot.joint_count; ++j) {
      joints.wanted_rad[j] = random.between(-9, 9);
      if (random.bits() % 50 == 0) joints.wanted_rad[j] = test::quiet_nan();
      joints.position_count[j] = static_cast<std::int32_t>(random.bits());
    }
    const LimitState before = joints.state;
    const bool limp = random.bits() % 16 == 0;
    const Mode mode = limp ? Mode::kFallen : kTorqueModes[random.below(5)];
    joints.run(mode, static_cast<std::int32_t>(random.bits()));
    for (int j = 0; j < kRobot.joint_count; ++j) {
      const float goal_rad = joints.state.goal_rad[j];
      ASSERT_GE(goal_rad, kRobot.joint[j].lower_rad) << "joint " << j;
      ASSERT_LE(goal_rad, kRobot.joint[j].upper_rad) << "joint " << j;
      if (limp) continue;
      ASSERT_LE(math::abs(goal_rad - before.goal_rad[j]), kMost_rad + 1e-6F) << "joint " << j;
    }
  }
}

TEST(Limit, WithoutTorqueGoalsFollowTheJoints) {
  for (const Mode mode : {Mode::kRelaxed, Mode::kFallen, Mode::kStopped}) {
    Joints joints;
    for (int j = 0; j < kRobot.joint_count; ++j) {
      joints.wanted_rad[j] = 0.2F;
      joints.position_count[j] = model::count_of(kRobot.joint[j], 0.05F);
    }
    EXPECT_FALSE(joints.run(mode, 0).slowed);
    for (int j = 0; j < kRobot.joint_count; ++j) {
      EXPECT_NEAR(joints.state.goal_rad[j], 0.05F, 1e-3F);
    }
  }
}

TEST(Limit, HoldingFreezesGoals) {
  Joints joints;
  for (int j = 0; j < kRobot.joint_count; ++j) joints.state.goal_rad[j] = 0.07F;
  joints.run(Mode::kHolding, 0);
  for (int j = 0; j < kRobot.joint_count; ++j) EXPECT_EQ(joints.state.goal_rad[j], 0.07F);
}

TEST(Limit, WithinSpeedTheGoalIsTheWish) {
  Joints joints;
  for (int j = 0; j < kRobot.joint_count; ++j) joints.wanted_rad[j] = 0.07F;
  EXPECT_FALSE(joints.run(Mode::kWalking, 0).slowed);
  EXPECT_EQ(joints.state.goal_rad[0], 0.07F);
  joints.wanted_rad[0] = 0.5F;
  EXPECT_TRUE(joints.run(Mode::kWalking, 0).slowed) << "slowed down, and said so";
}

// On a minimum-jerk curve, exactly to the target.
void expect_arrives(Mode mode, float duration_s) {
  test::Random random(2);
  Joints joints;
  for (int j = 0; j < kRobot.joint_count; ++j) {
    joints.wanted_rad[j] = kRobot.joint[j].stand_rad;
    joints.state.goal_rad[j] = random.between(kRobot.joint[j].lower_rad, kRobot.joint[j].upper_rad);
  }
  const LimitState start = joints.state;
  float first_rad = 0, fastest_rad = 0;
  for (std::int32_t us = 0; us <= static_cast<std::int32_t>(duration_s * 1e6F); us += kPeriod_us) {
    const LimitState before = joints.state;
    joints.run(mode, us);
    for (int j = 0; j < kRobot.joint_count; ++j) {
      const float move_rad = math::abs(joints.state.goal_rad[j] - before.goal_rad[j]);
      if (us < 3 * kPeriod_us) first_rad = math::max(first_rad, move_rad);
      fastest_rad = math::max(fastest_rad, move_rad);
    }
  }
  EXPECT_LT(first_rad, 0.1F * fastest_rad) << "starts softly";
  for (int j = 0; j < kRobot.joint_count; ++j) {
    const float end_rad = mode == Mode::kSitting ? kRobot.joint[j].sit_rad : joints.wanted_rad[j];
    EXPECT_NEAR(joints.state.goal_rad[j], end_rad, 1e-5F) << "joint " << j;
    EXPECT_LT(fastest_rad, kMost_rad) << "from " << start.goal_rad[j];
  }
}

TEST(Limit, RiseEndsInTheStand) {
  expect_arrives(Mode::kRising, SafetyTuning{}.rise_s);
}
TEST(Limit, SittingDownEndsInTheCrouch) {
  expect_arrives(Mode::kSitting, SafetyTuning{}.sit_s);
}

TEST(Limit, RiseTakesAsLongAsItsLongestWayNeeds) {
  for (const Mode mode : {Mode::kRising, Mode::kSitting}) {
    static Params slow;
    slow = kRobot;
    constexpr int kSlow = 3;  // a shoulder
    slow.joint[kSlow].velocity_limit_rad_s = 0.5F;
    Joints joints;
    for (int j = 0; j < slow.joint_count; ++j) joints.wanted_rad[j] = slow.joint[j].stand_rad;
    const float end_rad =
        mode == Mode::kSitting ? slow.joint[kSlow].sit_rad : slow.joint[kSlow].stand_rad;
    joints.state.goal_rad[kSlow] = end_rad + 1.5F;
    joints.run(mode, 0, slow);
    EXPECT_GE(joints.way_ms, 1875 * 15 / 5);
    float fastest_rad = 0, before_rad = joints.state.goal_rad[kSlow];
    const auto end_us = std::int32_t{1000} * joints.way_ms;
    for (std::int32_t us = kPeriod_us; us <= end_us; us += kPeriod_us) {
      joints.run(mode, us, slow);
      fastest_rad = math::max(fastest_rad, math::abs(joints.state.goal_rad[kSlow] - before_rad));
      before_rad = joints.state.goal_rad[kSlow];
    }
    EXPECT_NEAR(joints.state.goal_rad[kSlow], end_rad, 1e-3F);
    EXPECT_LT(fastest_rad, 0.5F * 0.01F) << "its own speed is enough";
    EXPECT_GT(fastest_rad, 0.8F * 0.5F * 0.01F) << "and it is not slower than it needs";
  }
}

TEST(Limit, ShortWaysTakeTheTimeThatTheTuningGivesThem) {
  Joints joints;
  for (int j = 0; j < kRobot.joint_count; ++j) joints.wanted_rad[j] = 0.1F;
  joints.run(Mode::kRising, 0);
  EXPECT_EQ(joints.way_ms, 1000) << "rise_s";
  joints.run(Mode::kSitting, 0);
  EXPECT_EQ(joints.way_ms, 1500) << "sit_s";
}

// It lies against its stop.
TEST(Limit, JointBeyondItsLimitsIsNamed) {
  for (int j = 0; j < kRobot.joint_count; ++j) {
    const JointParams& joint = kRobot.joint[j];
    Joints joints;
    for (int k = 0; k < kRobot.joint_count; ++k) {
      joints.position_count[k] = model::count_of(kRobot.joint[k], kRobot.joint[k].sit_rad);
    }
    EXPECT_FALSE(joints.run(Mode::kRelaxed, 0).beyond);
    EXPECT_EQ(joint_beyond(kRobot, joints.position_count), kMaxJoints);
    for (const float side : {-1.0F, 1.0F}) {
      const float limit_rad = side > 0 ? joint.upper_rad : joint.lower_rad;
      joints.position_count[j] = model::count_of(joint, limit_rad + side * 0.9F * kBeyond_rad);
      EXPECT_FALSE(joints.run(Mode::kRelaxed, 0).beyond) << joint.name;
      joints.position_count[j] = model::count_of(joint, limit_rad + side * 1.1F * kBeyond_rad);
      EXPECT_TRUE(joints.run(Mode::kRelaxed, 0).beyond) << joint.name;
      EXPECT_EQ(joint_beyond(kRobot, joints.position_count), j);
      EXPECT_FALSE(joints.run(Mode::kStanding, 0).beyond) << "it holds its goal";
    }
  }
}

TEST(Limit, RiseFollowsAMovingStand) {
  Joints joints;
  for (std::int32_t us = 0; us <= 1000000; us += kPeriod_us) {
    joints.wanted_rad[0] = 0.3F + 0.2e-6F * static_cast<float>(us);
    joints.run(Mode::kRising, us);
  }
  EXPECT_NEAR(joints.state.goal_rad[0], 0.5F, 1e-5F);
}

}  // namespace
}  // namespace verp::safety
