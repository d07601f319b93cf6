#include "common/balance/trim.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::balance {
namespace {

using test::kRobot;

// 3.3 kg on one foot, in counts of 10 mN, with the pressure moved by shares of half a sole.
struct Pressure {
  std::uint16_t count[kFootSensors];
  Pressure(float ahead, float left) {
    for (int i = 0; i < kFootSensors; ++i) {
      const float x = i < 2 ? ahead : -ahead, y = i % 2 == 0 ? left : -left;
      count[i] = static_cast<std::uint16_t>(800 * (1 + x) * (1 + y));
    }
  }
};

LegCorrection learnt(const AttitudeOut& attitude, const Pressure& pressure, int carrying,
                     int ticks = 10, bool fresh = true, float trim_time_s = 2) {
  Tuning tuning;
  tuning.gait.zmp_x_m = tuning.gait.zmp_y_m = 0;
  tuning.balance.trim_time_s = trim_time_s;
  TrimState state;
  for (int i = 0; i < ticks; ++i) {
    learn(kRobot, tuning, attitude, {fresh, pressure.count, carrying, 0.0F, 0.01F}, state);
  }
  for_each_leaf(state.leg[1 - carrying], [](float& angle) { EXPECT_EQ(angle, 0.0F); });
  return state.leg[carrying];
}

AttitudeOut tilted(float roll_rad, float pitch_rad) {
  AttitudeOut out;
  out.roll_rad = roll_rad;
  out.pitch_rad = pitch_rad;
  return out;
}

TEST(Trim, PressureCenterIsAShareOfTheSole) {
  const gait::Xy center = pressure_center(Pressure(0.5F, -0.25F).count);
  EXPECT_NEAR(center.x, 0.5F, 1e-2F);
  EXPECT_NEAR(center.y, -0.25F, 1e-2F);
  const std::uint16_t none[kFootSensors] = {};
  EXPECT_EQ(pressure_center(none).x, 0.0F);
  const std::uint16_t corner[kFootSensors] = {0xFFFF, 0, 0, 0};
  EXPECT_EQ(pressure_center(corner).x, 1.0F);
  EXPECT_EQ(pressure_center(corner).y, 1.0F);
}

TEST(Trim, AsPlannedThereIsNothingToLearn) {
  const LegCorrection trim = learnt({}, {0, 0}, 0);
  for_each_leaf(trim, [](const float& angle) { EXPECT_NEAR(angle, 0.0F, 1e-5F); });
}

TEST(Trim, OppositeErrorsAreLearntWithOppositeSigns) {
  const LegCorrection one = learnt(tilted(0.02F, 0.03F), {0.3F, 0.2F}, 1);
  const LegCorrection other = learnt(tilted(-0.02F, -0.03F), {-0.3F, -0.2F}, 1);
  EXPECT_NE(one.ankle_pitch_rad, 0.0F);
  EXPECT_NE(one.ankle_roll_rad, 0.0F);
  EXPECT_NE(one.hip_roll_rad, 0.0F);
  EXPECT_NE(one.hip_pitch_rad, 0.0F);
  EXPECT_NEAR(one.ankle_pitch_rad, -other.ankle_pitch_rad, 1e-5F);
  EXPECT_NEAR(one.ankle_roll_rad, -other.ankle_roll_rad, 1e-5F);
  EXPECT_NEAR(one.hip_roll_rad, -other.hip_roll_rad, 1e-6F);
  EXPECT_NEAR(one.hip_pitch_rad, -other.hip_pitch_rad, 1e-6F);
}

TEST(Trim, SwitchedOffLearnsNothing) {
  const LegCorrection trim = learnt(tilted(0.1F, 0.1F), {0.5F, 0.5F}, 0, 100, true, 0);
  for_each_leaf(trim, [](const float& angle) { EXPECT_EQ(angle, 0.0F); });
}

TEST(Trim, OldPressuresTeachNothing) {
  const LegCorrection trim = learnt({}, {0.5F, 0.5F}, 0, 100, false);
  EXPECT_EQ(trim.ankle_pitch_rad, 0.0F);
  EXPECT_EQ(trim.ankle_roll_rad, 0.0F);
}

TEST(Trim, IsLimited) {
  const LegCorrection trim = learnt(tilted(1, -1), {1, 1}, 0, 3000);
  for_each_leaf(trim, [](const float& angle) { EXPECT_LE(math::abs(angle), kMaxTrim_rad); });
  EXPECT_EQ(math::abs(trim.hip_roll_rad), kMaxTrim_rad);
}

}  // namespace
}  // namespace verp::balance
