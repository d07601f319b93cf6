#include <gtest/gtest.h>

#include "common/control/stages.hpp"
#include "tests/unit/control/loop.hpp"

namespace verp::control {
namespace {

/// About y, after 10 s.
float leans_rad(float pitch_rad, float planned_rad, safety::Mode mode, bool imu_fresh) {
  State& walker = test::fresh_loop().state;
  walker.machine.mode = mode;
  walker.tuning.gait.trunk_pitch_rad = planned_rad;
  AdmitOut admitted{};
  admitted.imu_fresh = imu_fresh;
  balance::AttitudeOut attitude;
  attitude.pitch_rad = pitch_rad;
  gait::GaitOut plan{};
  for (int tick = 0; tick < 1000; ++tick) lean(test::kRobot, walker, admitted, attitude, plan);
  return walker.lean.lean_rad.y;
}

TEST(LeanStage, ItIsTheTiltOffThePlanThatIsLeanedAgainst) {
  constexpr float kPitch_rad = 1.5F * balance::kLeftPitched_rad;
  const auto walks = safety::Mode::kWalking;
  EXPECT_EQ(leans_rad(kPitch_rad, kPitch_rad, walks, true), 0.0F);
  EXPECT_LT(leans_rad(kPitch_rad, 0.0F, walks, true), -0.02F);
  EXPECT_GT(leans_rad(0.0F, kPitch_rad, walks, true), 0.02F);
}

TEST(LeanStage, WhoStandsOrHasNoImuLearnsNothing) {
  EXPECT_EQ(leans_rad(0.2F, 0.0F, safety::Mode::kStanding, true), 0.0F);
  EXPECT_EQ(leans_rad(0.2F, 0.0F, safety::Mode::kWalking, false), 0.0F);
}

}  // namespace
}  // namespace verp::control
