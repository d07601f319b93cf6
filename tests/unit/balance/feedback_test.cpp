#include "common/balance/feedback.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::balance {
namespace {

AttitudeOut tilted(float roll_rad, float pitch_rad, float rate_rad_s = 0) {
  AttitudeOut out;
  out.roll_rad = roll_rad;
  out.pitch_rad = pitch_rad;
  out.roll_rate_rad_s = out.pitch_rate_rad_s = rate_rad_s;
  return out;
}

float largest(const FeedbackOut& out) {
  float result = 0;
  for_each_leaf(out, [&](const float& angle) { result = math::max(result, math::abs(angle)); });
  return result;
}

TEST(Feedback, SwitchedOffAddsNothing) {
  BalanceTuning tuning;
  tuning.feedback_enable = 0;
  EXPECT_EQ(largest(feedback(tuning, tilted(0.5F, 0.5F, 3), 0, gait::kBoth)), 0.0F);
}

TEST(Feedback, AsPlannedAddsNothing) {
  EXPECT_EQ(largest(feedback({}, tilted(0, 0.05F), 0.05F, gait::kLeft)), 0.0F);
}

TEST(Feedback, OppositeTiltsGiveOppositeCorrections) {
  const FeedbackOut one = feedback({}, tilted(0.1F, -0.05F, 0.3F), 0, gait::kLeft);
  const FeedbackOut other = feedback({}, tilted(-0.1F, 0.05F, -0.3F), 0, gait::kLeft);
  for (int side = 0; side < kFeet; ++side) {
    EXPECT_EQ(one.leg[side].hip_roll_rad, -other.leg[side].hip_roll_rad);
    EXPECT_EQ(one.leg[side].hip_pitch_rad, -other.leg[side].hip_pitch_rad);
    EXPECT_EQ(one.leg[side].ankle_roll_rad, -other.leg[side].ankle_roll_rad);
    EXPECT_EQ(one.leg[side].ankle_pitch_rad, -other.leg[side].ankle_pitch_rad);
  }
}

TEST(Feedback, SwingLegOnlyLevelsItsFoot) {
  const FeedbackOut swing = feedback({}, tilted(0.1F, 0.1F), 0, gait::kRight);
  EXPECT_EQ(swing.leg[1].hip_roll_rad, 0.0F);
  EXPECT_EQ(swing.leg[1].hip_pitch_rad, 0.0F);
  EXPECT_LT(swing.leg[1].ankle_roll_rad, 0.0F);
  EXPECT_LT(swing.leg[1].ankle_pitch_rad, 0.0F);
  const FeedbackOut both = feedback({}, tilted(0.1F, 0.1F), 0, gait::kBoth);
  EXPECT_EQ(both.leg[0].ankle_roll_rad, both.leg[1].ankle_roll_rad);
  EXPECT_NE(both.leg[0].hip_roll_rad, 0.0F);
  EXPECT_LT(2.0F * math::abs(both.leg[0].hip_roll_rad), math::abs(swing.leg[0].hip_roll_rad))
      << "two legs do less than one alone";
}

TEST(Feedback, CorrectionsAreLimited) {
  const BalanceTuning tuning;
  EXPECT_LE(largest(feedback(tuning, tilted(3, -3, 100), 0, gait::kLeft)),
            tuning.feedback_limit_rad);
  EXPECT_LE(
      largest(feedback(tuning, tilted(test::quiet_nan(), test::infinity(), 0), 0, gait::kLeft)),
      tuning.feedback_limit_rad);
}

TEST(Feedback, GoesToHipAndAnkleThroughTheLegsDirections) {
  LegParams leg = test::kRobot.leg[0];
  leg.direction[4] = -1;
  float leg_rad[kLegJoints] = {};
  add(leg, {0.1F, 0.2F, 0.3F, 0.4F}, leg_rad);
  const float wanted_rad[kLegJoints] = {0, 0.1F, 0.2F, 0, -0.3F, 0.4F};
  for (int k = 0; k < kLegJoints; ++k) EXPECT_EQ(leg_rad[k], wanted_rad[k]) << "joint " << k;
}

}  // namespace
}  // namespace verp::balance
