#include "common/balance/landing.hpp"

#include <gtest/gtest.h>

#include "common/model/counts.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::balance {
namespace {

using gait::kLeft;
using gait::kRight;
using test::kRobot;

constexpr float kStride_m = 0.08F, kHalfStance_m = 0.0356F, kSoleBelowBody_m = 0.2688F;
constexpr float kWay_m = 2 * kStride_m;

// Each foot lands one stride ahead of the other.
struct Walk {
  gait::GaitState gait;
  gait::GaitOut plan;
  Inputs inputs;
  LandingState state;
  int landed = kRight;
  bool as_planned = true;

  gait::Foothold foothold(int side, float ahead_m) const {
    return {{ahead_m, side == kLeft ? kHalfStance_m : -kHalfStance_m}, 0};
  }
  void read(int side, float ahead_m) {
    const LegParams& leg = kRobot.leg[side];
    const gait::Xy at_m = foothold(side, ahead_m - 0.5F * kStride_m).at_m;
    const Pose sole{Mat3::Identity(), {at_m.x, at_m.y, -kSoleBelowBody_m}};
    const float previous_rad[kLegJoints] = {};
    const kinematics::LegAngles solved = kinematics::solve_leg(kRobot, leg, sole, previous_rad);
    ASSERT_EQ(int{solved.flags}, 0);
    for (int k = 0; k < kLegJoints; ++k) {
      const std::uint8_t j = leg.joint[k];
      inputs.position_count[j] = model::count_of(kRobot.joint[j], solved.angle_rad[k]);
    }
  }
  void land(float beyond_m) {
    landed = 1 - landed;
    const int other = 1 - landed;
    gait.queued = 1;
    gait.previous.foot[landed] = foothold(landed, -kStride_m);
    gait::Step& step = gait.queue[0];
    step.key_us = 13333;
    step.key_points = 15;
    step.landed = static_cast<std::uint8_t>(landed);
    step.swing = static_cast<std::uint8_t>(other);
    step.foot[landed] = foothold(landed, kStride_m);
    step.foot[other] = foothold(other, 0);
    step.landing = foothold(other, 2 * kStride_m);
    read(landed, kStride_m + beyond_m);
    read(other, 0);
    plan.carrying = static_cast<std::uint8_t>(landed);
    learn_landing(kRobot, gait, plan, inputs, as_planned, state);
  }
  float aimed_ahead_m(int side, float ahead_m) const {
    gait::FootPose planned;
    planned.on = foothold(side, ahead_m);
    return aim(gait, state, side, planned).on.at_m.x;
  }
};

Walk walking() {
  Walk walk;
  walk.inputs.fresh = 0xFFFFFFFFU;
  return walk;
}

TEST(Landing, FeetThatLandAsPlannedAreAimedAsPlanned) {
  Walk walk = walking();
  walk.land(0);
  EXPECT_NEAR(walk.state.beyond, 0.0F, 0.002F) << "an encoder's step is 1.5 mrad";
  walk.state.beyond = 0;
  EXPECT_EQ(walk.aimed_ahead_m(1 - walk.landed, 0.05F), 0.05F);
  EXPECT_EQ(walk.aimed_ahead_m(walk.landed, kStride_m), kStride_m);
}

// The servos swing a leg a tenth too far.
TEST(Landing, AFootThatSwingsTooFarIsAimedShorterUntilItLandsAsPlanned) {
  Walk walk = walking();
  float beyond_m = 0;
  for (int step = 0; step < 40; ++step) {
    beyond_m = 1.1F * (1.0F - walk.state.beyond) * kWay_m - kWay_m;
    walk.land(beyond_m);
  }
  EXPECT_NEAR(beyond_m, 0.0F, 0.002F);
  EXPECT_NEAR(walk.state.beyond, 0.1F / 1.1F, 0.01F);
}

TEST(Landing, FeetThatLandTooSoonAreAimedFurther) {
  Walk walk = walking();
  for (int step = 0; step < 10; ++step) walk.land(-0.005F);
  EXPECT_LT(walk.state.beyond, -0.02F);
}

TEST(Landing, AimsShorterAsTheFootSwingsAndReturnsOnceItStands) {
  Walk walk = walking();
  walk.land(0);
  walk.state.beyond = 0.1F;
  const int swing = 1 - walk.landed;
  EXPECT_EQ(walk.aimed_ahead_m(swing, 0), 0.0F) << "where it stands";
  EXPECT_NEAR(walk.aimed_ahead_m(swing, kWay_m), 0.9F * kWay_m, 1e-6F);
  walk.gait.clock_us = 0;
  EXPECT_NEAR(walk.aimed_ahead_m(walk.landed, kStride_m), kStride_m - 0.1F * kWay_m, 1e-6F)
      << "goes on from where the swing was aimed";
  walk.gait.clock_us = walk.gait.queue[0].duration_us() / 2;
  EXPECT_EQ(walk.aimed_ahead_m(walk.landed, kStride_m), kStride_m);
  walk.gait.queued = 0;
  EXPECT_EQ(walk.aimed_ahead_m(walk.landed, kStride_m), kStride_m) << "it stands";
}

TEST(Landing, LearnsOnlyFromReadingsOfALandingThatMoved) {
  Walk walk = walking();
  walk.inputs.fresh &= ~(1U << kRobot.leg[kLeft].joint[3]);
  for (int step = 0; step < 4; ++step) walk.land(0.02F);
  EXPECT_EQ(walk.state.beyond, 0.0F) << "a knee is silent";
  walk.inputs.fresh = 0xFFFFFFFFU;
  walk.as_planned = false;
  walk.land(0.02F);
  EXPECT_EQ(walk.state.beyond, 0.0F) << "it was sent elsewhere";
  walk.as_planned = true;
  walk.land(0.02F);
  const float once = walk.state.beyond;
  EXPECT_GT(once, 0.01F);
  learn_landing(kRobot, walk.gait, walk.plan, walk.inputs, true, walk.state);
  EXPECT_EQ(walk.state.beyond, once) << "the same landing, a tick later";
  walk.gait.previous.foot[kLeft] = walk.gait.queue[0].foot[kLeft];
  walk.gait.previous.foot[kRight] = walk.gait.queue[0].foot[kRight];
  walk.state.carrying = gait::kBoth;
  learn_landing(kRobot, walk.gait, walk.plan, walk.inputs, true, walk.state);
  EXPECT_EQ(walk.state.beyond, once) << "a step on the spot";
}

TEST(Landing, KeepsWithinItsBoundsWhateverTheEncodersSay) {
  Walk walk = walking();
  for (int step = 0; step < 200; ++step) walk.land(0.06F);
  EXPECT_LE(walk.state.beyond, 0.3F);
  EXPECT_GT(walk.state.beyond, 0.25F) << "it has tried";
}

}  // namespace
}  // namespace verp::balance
