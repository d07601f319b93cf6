#include "common/balance/lean.hpp"

#include <gtest/gtest.h>

namespace verp::balance {
namespace {

constexpr float kTick_s = 0.01F;
constexpr float kTicks_per_s = 1.0F / kTick_s;

// What is left of a slope's roll when the body leans against it.
AttitudeOut across(float slope_rad, const LeanState& state, float sway_rad = 0.0F) {
  AttitudeOut attitude;
  attitude.roll_rad = slope_rad + state.lean_rad + sway_rad;
  return attitude;
}

LeanState walked(float slope_rad, float time_s, float sway_rad = 0.0F) {
  LeanState state;
  for (int i = 0; i < static_cast<int>(time_s * kTicks_per_s); ++i) {
    const float cycles = static_cast<float>(i % 45) / 45.0F;
    const float sway = sway_rad * math::sincos(2.0F * math::kPi * cycles).sin;
    learn_lean(across(slope_rad, state, sway), kTick_s, state);
  }
  return state;
}

// Offsets of sensors and what a step sways are no slope: not a bit of the plan changes.
TEST(Lean, OnLevelGroundThePlanStaysAsItIs) {
  for (const float slope_rad : {-0.8F * kLeftTilted_rad, 0.0F, 0.8F * kLeftTilted_rad}) {
    const LeanState state = walked(slope_rad, 30.0F, 0.05F);
    EXPECT_EQ(state.lean_rad, 0.0F);
    gait::Posture posture;
    posture.body.position_m = Vec3(0.1F, 0.2F, 0.25F);
    lean(state, posture);
    EXPECT_EQ(posture.body.position_m.y(), 0.2F);
    EXPECT_EQ(posture.body.rotation(2, 1), 0.0F);
  }
}

TEST(Lean, AcrossFiveDegreesTheBodyIsUprightButForWhatIsLeft) {
  for (const float slope_rad : {-0.0873F, 0.0873F}) {
    const LeanState state = walked(slope_rad, 15.0F, 0.02F);
    EXPECT_LT(math::abs(slope_rad + state.lean_rad), kLeftTilted_rad + 0.001F);
    EXPECT_GT(math::abs(slope_rad + state.lean_rad), 0.5F * kLeftTilted_rad);
    EXPECT_LT(slope_rad * state.lean_rad, 0.0F);
  }
}

// And stands on it no further than a tenth of a radian turned, whatever an IMU may say.
TEST(Lean, IsBounded) {
  EXPECT_EQ(walked(3.0F, 60.0F).lean_rad, -0.1F);
  EXPECT_EQ(walked(-3.0F, 60.0F).lean_rad, 0.1F);
}

// The point of the ground under the body stays where it is; `yaw_rad`: wherever the robot looks.
TEST(Lean, TurnsTheBodyAboutTheGroundUnderIt) {
  const LeanState state{.tilt_rad = 0.0F, .lean_rad = 0.06F};
  for (const float yaw_rad : {0.0F, 1.2F, -2.5F}) {
    gait::Posture posture;
    posture.body.position_m = Vec3(0.3F, -0.1F, 0.25F);
    posture.body.rotation = math::rot_z(yaw_rad) * math::rot_y(0.03F);
    const gait::Posture before = posture;
    lean(state, posture);
    const Vec3 up_before = before.body.rotation.transpose() * Vec3(0, 0, 1);
    const Vec3 up = posture.body.rotation.transpose() * Vec3(0, 0, 1);
    EXPECT_NEAR(up.dot(up_before), math::cos(0.06F), 1e-5F);
    EXPECT_NEAR(up.y() - up_before.y(), math::sin(0.06F), 1e-3F)
        << "turned like roll, to the right";
    const Vec3 way = posture.body.position_m - before.body.position_m;
    const Vec3 left = before.body.rotation * Vec3(0, 1, 0);
    EXPECT_NEAR(way.dot(left), -0.06F * 0.25F, 1e-6F) << "and goes there";
    EXPECT_NEAR(way.norm(), 0.06F * 0.25F, 1e-6F);
  }
}

}  // namespace
}  // namespace verp::balance
