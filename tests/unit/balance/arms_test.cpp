#include "common/balance/arms.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::balance {
namespace {

using test::kLeftArm;
using test::kRightArm;

const float kRadPerM = test::kRobot.arm_rad_per_m[gait::kLeft];

// The left foot is `ahead_m` ahead of the right one.
gait::Posture posture(float ahead_m, float yaw_rad) {
  gait::Posture out;
  out.body.rotation = math::rot_z(yaw_rad);
  out.foot[gait::kLeft].on.at_m = gait::turned({ahead_m, 0.04F}, yaw_rad);
  out.foot[gait::kRight].on.at_m = gait::turned({0, -0.04F}, yaw_rad);
  return out;
}

struct Swung {
  float angle_rad[kMaxJoints] = {};
};

Swung swung(const Params& params, const BalanceTuning& tuning, const gait::Posture& posture) {
  Swung out;
  swing_arms(params, tuning, posture, out.angle_rad);
  return out;
}

float largest_rad(const Swung& swung) {
  float most_rad = 0;
  for (const float angle_rad : swung.angle_rad) {
    most_rad = math::max(most_rad, math::abs(angle_rad));
  }
  return most_rad;
}

TEST(Arms, SwitchedOffRest) {
  BalanceTuning tuning;
  tuning.arm_swing = 0;
  EXPECT_EQ(largest_rad(swung(test::kRobot, tuning, posture(0.1F, 0))), 0.0F);
}

TEST(Arms, OfARobotWithoutThemMoveNothing) {
  Params params = test::make_robot();
  params.arm[gait::kLeft] = params.arm[gait::kRight] = 0xFF;
  EXPECT_EQ(largest_rad(swung(params, {}, posture(0.1F, 0))), 0.0F);
}

TEST(Arms, RestWhileTheFeetStandSideBySide) {
  for (const float yaw_rad : {0.0F, 0.7F, -2.5F}) {
    EXPECT_LT(largest_rad(swung(test::kRobot, {}, posture(0, yaw_rad))), 1e-6F);
  }
}

// About y, a larger angle is further back.
TEST(Arms, SwingBackWithTheFootThatIsAhead) {
  for (const float yaw_rad : {0.0F, 0.7F, -2.5F}) {
    for (const float ahead_m : {-0.1F, 0.02F, 0.05F}) {
      const Swung out = swung(test::kRobot, {}, posture(ahead_m, yaw_rad));
      EXPECT_NEAR(out.angle_rad[kLeftArm], BalanceTuning{}.arm_swing * kRadPerM * ahead_m, 1e-5F);
      EXPECT_NEAR(out.angle_rad[kRightArm], -BalanceTuning{}.arm_swing * kRadPerM * ahead_m, 1e-5F);
    }
  }
}

TEST(Arms, SwingNoFurtherThanAPersonWould) {
  EXPECT_EQ(largest_rad(swung(test::kRobot, {}, posture(0.3F, 0))), 0.6F);
}

TEST(Arms, AJointBeyondTheLastIsNone) {
  Params params = test::make_robot();
  params.arm[gait::kRight] = 0xFF;
  for (int none = params.joint_count; none < kMaxJoints; ++none) {
    params.arm[gait::kLeft] = static_cast<std::uint8_t>(none);
    EXPECT_EQ(largest_rad(swung(params, {}, posture(0.1F, 0))), 0.0F) << none;
  }
}

}  // namespace
}  // namespace verp::balance
