#include "common/balance/lean.hpp"

#include <gtest/gtest.h>

namespace verp::balance {
namespace {

constexpr float kTick_s = 0.01F;
constexpr float kTicks_per_s = 1.0F / kTick_s;

constexpr float kTrunk_rad = 0.03F;  // nose down

struct Ground {
  float roll_rad = 0, pitch_rad = 0;
};

// The tilt that remains of a slope.
AttitudeOut on(const Ground& ground, const LeanState& state, float sway_rad = 0.0F) {
  AttitudeOut attitude;
  attitude.roll_rad = ground.roll_rad + state.lean_rad.x + sway_rad;
  attitude.pitch_rad = kTrunk_rad + ground.pitch_rad + state.lean_rad.y + sway_rad;
  return attitude;
}

LeanState walked(const Ground& ground, float time_s, float sway_rad = 0.0F) {
  LeanState state;
  for (int i = 0; i < static_cast<int>(time_s * kTicks_per_s); ++i) {
    const float cycles = static_cast<float>(i % 45) / 45.0F;
    const float sway = sway_rad * math::sincos(2.0F * math::kPi * cycles).sin;
    learn_lean(on(ground, state, sway), kTrunk_rad, kTick_s, state);
  }
  return state;
}

// Sensor offsets and sway are no slope.
TEST(Lean, OnLevelGroundThePlanStaysAsItIs) {
  for (const float share : {-0.8F, 0.0F, 0.8F}) {
    const LeanState state =
        walked({share * kLeftTilted_rad, share * kLeftPitched_rad}, 30.0F, 0.05F);
    EXPECT_EQ(state.lean_rad.x, 0.0F);
    EXPECT_EQ(state.lean_rad.y, 0.0F);
    gait::Posture posture;
    posture.body.position_m = Vec3(0.1F, 0.2F, 0.25F);
    lean(state, posture);
    EXPECT_EQ(posture.body.position_m.x(), 0.1F);
    EXPECT_EQ(posture.body.position_m.y(), 0.2F);
    EXPECT_EQ(posture.body.rotation(2, 0), 0.0F);
    EXPECT_EQ(posture.body.rotation(2, 1), 0.0F);
  }
}

TEST(Lean, AcrossFiveDegreesTheBodyIsUprightButForWhatIsLeft) {
  for (const float slope_rad : {-0.0873F, 0.0873F}) {
    const LeanState state = walked({.roll_rad = slope_rad}, 15.0F, 0.02F);
    EXPECT_LT(math::abs(slope_rad + state.lean_rad.x), kLeftTilted_rad + 0.001F);
    EXPECT_GT(math::abs(slope_rad + state.lean_rad.x), 0.5F * kLeftTilted_rad);
    EXPECT_LT(slope_rad * state.lean_rad.x, 0.0F);
    EXPECT_EQ(state.lean_rad.y, 0.0F);
  }
}

// With its toes on the edge, the robot would take leaning back for falling.
TEST(Lean, OnTheEdgeOfACentimetreTheBodyIsUprightButForWhatIsLeft) {
  for (const float slope_rad : {-0.12F, 0.12F}) {
    const LeanState state = walked({.pitch_rad = slope_rad}, 15.0F, 0.02F);
    EXPECT_LT(math::abs(slope_rad + state.lean_rad.y), kLeftPitched_rad + 0.001F);
    EXPECT_GT(math::abs(slope_rad + state.lean_rad.y), 0.5F * kLeftPitched_rad);
    EXPECT_LT(slope_rad * state.lean_rad.y, 0.0F);
    EXPECT_EQ(state.lean_rad.x, 0.0F);
  }
}

// A robot that kept leaning would run off.
TEST(Lean, OffTheSlopeItIsUprightAgain) {
  LeanState state = walked({0.12F, -0.16F}, 15.0F);
  EXPECT_LT(state.lean_rad.x, -0.07F);
  EXPECT_GT(state.lean_rad.y, 0.07F);
  for (int i = 0; i < 12 * static_cast<int>(kTicks_per_s); ++i)
    learn_lean(on({}, state), kTrunk_rad, kTick_s, state);
  EXPECT_NEAR(state.lean_rad.x, 0.0F, 1e-4F);
  EXPECT_NEAR(state.lean_rad.y, 0.0F, 1e-4F);
}

TEST(Lean, IsBounded) {
  for (const float sign : {-1.0F, 1.0F}) {
    const LeanState state = walked({sign * 3.0F, sign * 3.0F}, 60.0F);
    EXPECT_EQ(state.lean_rad.x, -0.1F * sign);
    EXPECT_EQ(state.lean_rad.y, -0.1F * sign);
  }
}

TEST(Lean, TurnsTheBodyAboutTheGroundUnderIt) {
  for (const float yaw_rad : {0.0F, 1.2F, -2.5F}) {
    for (const bool ahead : {false, true}) {
      LeanState state;
      (ahead ? state.lean_rad.y : state.lean_rad.x) = 0.06F;
      gait::Posture posture;
      posture.body.position_m = Vec3(0.3F, -0.1F, 0.25F);
      posture.body.rotation = math::rot_z(yaw_rad);
      const gait::Posture before = posture;
      lean(state, posture);
      const Vec3 up = posture.body.rotation.transpose() * Vec3(0, 0, 1);
      EXPECT_NEAR(up.z(), math::cos(0.06F), 1e-5F);
      EXPECT_NEAR(up.y(), ahead ? 0.0F : math::sin(0.06F), 1e-6F)
          << "turned like roll, to the right";
      EXPECT_NEAR(up.x(), ahead ? -math::sin(0.06F) : 0.0F, 1e-6F) << "like pitch, nose down";
      const Vec3 way = posture.body.position_m - before.body.position_m;
      const Vec3 there = before.body.rotation * (ahead ? Vec3(1, 0, 0) : Vec3(0, -1, 0));
      EXPECT_NEAR(way.dot(there), 0.06F * 0.25F, 1e-6F) << "and goes there";
      EXPECT_NEAR(way.norm(), 0.06F * 0.25F, 1e-6F);
    }
  }
}

}  // namespace
}  // namespace verp::balance
