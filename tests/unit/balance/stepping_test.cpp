#include "common/balance/stepping.hpp"

#include <gtest/gtest.h>

#include "common/balance/landing.hpp"
#include "common/gait/dcm.hpp"
#include "tests/unit/gait/walker.hpp"

namespace verp::balance {
namespace {

using gait::kLeft;
using gait::kRight;
using gait::Xy;
using test::kRobot;

constexpr float kPeriod_s = 0.01F;

void look(const gait::test::Walker& walker, Xy error_m, EstimatorState& estimator) {
  const gait::Step& step = walker.state.queue[0];
  if (walker.state.queued == 0 || step.swing == gait::kBoth) return;
  const int side = step.carrying();
  const float now_s =
      static_cast<float>(walker.state.clock_us) * 1e-6F - walker.tuning.gait.look_ahead_s;
  const Xy dcm_m = gait::dcm_at(step, walker.state.preview.omega, now_s) + error_m;
  const Xy sole_m = gait::sole_center(kRobot, side, step.foot[side]);
  estimator.com_from_body_m.x = dcm_m.x;
  estimator.com_from_body_m.y = dcm_m.y;
  estimator.sole_from_body_m[side] = {sole_m.x, sole_m.y, 0};
}

struct Pushed {
  gait::test::Walker walker{kRobot};
  EstimatorState estimator;
  SteppingState state;
  Xy error_m;
  gait::GaitOut planned;

  explicit Pushed(const gait::VelocityIn& wanted) {
    estimator.begun = 1;
    estimator.blind = 0;
    estimator.com_from_body_m.z = 0.2F;
    walker.set_off(wanted);
    ticks(300);
  }
  const gait::Step& step() const { return walker.state.queue[0]; }
  void tick() {
    walker.tick();
    look(walker, error_m, estimator);
    planned = walker.out;
    step_aside(kRobot, walker.tuning, {&walker.state, &estimator, 0, kPeriod_s}, state, walker.out);
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  // To the first tick of the next step of `side`.
  void to_swing_of(int side) {
    while (step().swing == side) tick();
    while (step().swing != side) tick();
  }
  void to_landing() {
    while (step().duration_us() - walker.state.clock_us > walker.in.period_us) tick();
  }
  Xy moved_m(int side) const {
    return walker.out.posture.foot[side].on.at_m - planned.posture.foot[side].on.at_m;
  }
};

Pushed ahead() {
  return Pushed({.vx_m_s = 0.1777F});
}

bool same(const gait::GaitOut& a, const gait::GaitOut& b) {
  bool same = a.zmp_m.x == b.zmp_m.x && a.zmp_m.y == b.zmp_m.y;
  for (int side = 0; side < kFeet; ++side) {
    const Xy one = a.posture.foot[side].on.at_m, other = b.posture.foot[side].on.at_m;
    same = same && one.x == other.x && one.y == other.y;
  }
  return same;
}

TEST(Stepping, WhatAnklesAnswerToMovesNoFoot) {
  Pushed walk = ahead();
  walk.error_m = {0.014F, -0.011F};
  for (int i = 0; i < 100; ++i) {
    walk.tick();
    ASSERT_TRUE(same(walk.walker.out, walk.planned)) << i;
  }
  EXPECT_TRUE(as_planned(walk.state, 1e-5F));
}

// Hurried walks correct almost every step, so learning must use corrected steps.
TEST(Stepping, AFootMovedByLessThanServosMissStillTeachesLandings) {
  Pushed walk = ahead();
  walk.error_m = {0.0165F, 0};
  walk.ticks(60);
  EXPECT_FALSE(as_planned(walk.state, 1e-4F));
  EXPECT_TRUE(as_planned(walk.state, kOffPlan_m));
}

TEST(Stepping, DoesNothingWithoutFeedbackOrEyesOrMassesOfLegsOrWhereJointsLag) {
  for (const int reason : {0, 1, 2, 3}) {
    Pushed walk = ahead();
    walk.error_m = {0.05F, 0};
    if (reason == 0) walk.walker.tuning.balance.feedback_enable = 0;
    if (reason == 1) walk.estimator.blind = 1;
    if (reason == 2) walk.walker.tuning.gait.joint_delay_s = 0.01F;
    if (reason == 3) walk.walker.tuning.balance.multibody_enable = 0;
    for (int i = 0; i < 100; ++i) {
      walk.tick();
      ASSERT_TRUE(same(walk.walker.out, walk.planned)) << reason << ", " << i;
    }
  }
}

TEST(Stepping, TheSwingFootLandsWhereTheDcmWent) {
  constexpr float kError_m = 0.04F, kAnkles_x_m = 0.29F * 0.052F, kAnkles_y_m = 0.36F * 0.033F;
  for (const int side : {kLeft, kRight}) {
    for (const Xy& way : {Xy{1, 0}, Xy{-1, 0}, Xy{0, side == kLeft ? 1.0F : -1.0F}}) {
      Pushed walk = ahead();
      walk.to_swing_of(side);
      walk.error_m = kError_m * way;
      walk.to_landing();
      const Xy moved_m = walk.moved_m(side);
      EXPECT_NEAR(moved_m.x, way.x * (kError_m - kAnkles_x_m), 0.002F) << side;
      EXPECT_NEAR(moved_m.y, way.y * (kError_m - kAnkles_y_m), 0.002F) << side;
      EXPECT_EQ(walk.moved_m(1 - side).x, 0.0F) << "the other one carries";
    }
  }
}

// Towards the carrying foot there is less room.
TEST(Stepping, SolesComeNoNearerThanThoseOfARobotThatStands) {
  Pushed walk = ahead();
  walk.to_swing_of(kLeft);
  walk.error_m = {0.03F, -0.06F};
  walk.to_landing();
  EXPECT_GT(walk.moved_m(kLeft).x, 0.01F);
  EXPECT_GT(walk.moved_m(kLeft).y, -0.001F);
  Pushed wide({.vy_m_s = 0.15F});
  wide.to_swing_of(kLeft);
  wide.error_m = {0, -0.06F};
  wide.to_landing();
  EXPECT_LT(wide.moved_m(kLeft).y, -0.01F) << "beside a step to the left there is";
  EXPECT_GT(gait::soles_apart_m(kRobot, wide.walker.out.posture.foot[kLeft].on,
                                wide.walker.out.posture.foot[kRight].on),
            0.005F);
}

TEST(Stepping, GoesOnFromTheFootThatCaughtItWithoutAJump) {
  Pushed walk = ahead();
  walk.to_swing_of(kRight);
  walk.error_m = {0.06F, -0.03F};
  walk.to_landing();
  walk.error_m = {};
  EXPECT_GT(walk.moved_m(kRight).x, 0.03F);
  Xy before_m[] = {walk.moved_m(kLeft), walk.moved_m(kRight)};
  for (int i = 0; i < 100; ++i) {
    walk.tick();
    for (int side = 0; side < kFeet; ++side) {
      const Xy now_m = walk.moved_m(side);
      ASSERT_LT(gait::test::apart(now_m, before_m[side]), 0.009F) << i << ", " << side;
      before_m[side] = now_m;
    }
  }
  EXPECT_LT(gait::test::apart(before_m[kLeft], Xy{}), 1e-3F);
  EXPECT_LT(gait::test::apart(before_m[kRight], Xy{}), 1e-3F);
}

TEST(Stepping, TheBodyCatchesUpWithoutMovingTheDcm) {
  Pushed walk = ahead();
  walk.to_swing_of(kRight);
  walk.error_m = {0.06F, 0};
  walk.to_landing();
  walk.error_m = {};
  walk.ticks(2);
  const float behind_m = walk.state.body_m.x;
  walk.tick();
  const float velocity_m_s = (walk.state.body_m.x - behind_m) / kPeriod_s;
  EXPECT_LT(behind_m, -0.03F);
  EXPECT_NEAR(velocity_m_s, -walk.walker.state.preview.omega * behind_m, 0.05F * velocity_m_s);
  EXPECT_EQ(walk.walker.out.zmp_m.x, walk.planned.zmp_m.x - walk.state.body_m.x);
}

TEST(Stepping, TheLastStepBringsTheFeetSideBySideAgain) {
  Pushed walk = ahead();
  walk.error_m = {0.05F, 0};
  walk.ticks(60);
  EXPECT_FALSE(as_planned(walk.state, 1e-5F));
  walk.walker.in.walk = false;
  for (int i = 0; i < 400 && walk.walker.state.queued > 0; ++i) walk.tick();
  ASSERT_EQ(int{walk.walker.state.queued}, 0);
  EXPECT_EQ(walk.state.foot_m.x, 0.0F);
  walk.ticks(200);
  EXPECT_TRUE(as_planned(walk.state, 1e-5F));
  EXPECT_TRUE(same(walk.walker.out, walk.planned));
}

// The DCM is `off_m` from the middle of the soles.
struct Stander {
  gait::test::Walker walker{kRobot};
  EstimatorState estimator;
  SteppingState state;
  bool steps = false;

  Stander() {
    estimator.begun = 1;
    estimator.blind = 0;
    estimator.com_from_body_m.z = 0.2F;
    estimator.sole_from_body_m[kLeft] = {0, 0.036F, 0};
    estimator.sole_from_body_m[kRight] = {0, -0.036F, 0};
    walker.run(1.5F);
  }
  bool pushed_by(Xy off_m) {
    estimator.com_from_body_m.x = off_m.x;
    estimator.com_from_body_m.y = off_m.y;
    return pushed(kRobot, walker.tuning, {&walker.state, &estimator, 0, kPeriod_s}, state);
  }
  // A push starts steps at once.
  void tick(Xy error_m) {
    steps = pushed(kRobot, walker.tuning, {&walker.state, &estimator, 0, kPeriod_s}, state);
    walker.in.walk = walker.in.at_once = steps;
    walker.tick();
    look(walker, error_m, estimator);
    step_aside(kRobot, walker.tuning, {&walker.state, &estimator, 0, kPeriod_s}, state, walker.out);
  }
};
constexpr float kHalfSole_m = 0.052F;

TEST(SteppingWherePushed, AnklesHoldFourFifthsOfASoleAheadAndBackwardAndAllOfItSideways) {
  Stander stander;
  for (const float way : {1.0F, -1.0F}) {
    EXPECT_FALSE(stander.pushed_by({way * 0.78F * kHalfSole_m, 0})) << way;
    EXPECT_TRUE(stander.pushed_by({way * 0.82F * kHalfSole_m, 0})) << way;
    EXPECT_FALSE(stander.pushed_by({0, way * 0.06F})) << way;
    EXPECT_FALSE(stander.pushed_by({})) << "it was held: nothing is left of it";
  }
}

TEST(SteppingWherePushed, AheadIsWhereTheRobotLooks) {
  Stander stander;
  EstimatorState& seen = stander.estimator;
  seen.sole_from_body_m[kLeft] = {-0.036F, 0, 0};
  seen.sole_from_body_m[kRight] = {0.036F, 0, 0};
  seen.com_from_body_m = {0, 0.05F, 0.2F};
  const float left_rad = 0.5F * math::kPi;
  EXPECT_TRUE(pushed(kRobot, stander.walker.tuning,
                     {&stander.walker.state, &seen, left_rad, kPeriod_s}, stander.state));
  EXPECT_FALSE(pushed(kRobot, stander.walker.tuning, {&stander.walker.state, &seen, 0, kPeriod_s},
                      stander.state));
}

TEST(SteppingWherePushed, NotWhereNothingWouldAnswerIt) {
  for (const int reason : {0, 1, 2, 3}) {
    Stander stander;
    ASSERT_TRUE(stander.pushed_by({0.05F, 0}));
    if (reason == 0) stander.walker.tuning.balance.feedback_enable = 0;
    if (reason == 1) stander.estimator.blind = 1;
    if (reason == 2) stander.walker.tuning.gait.joint_delay_s = 0.01F;
    if (reason == 3) stander.walker.tuning.balance.multibody_enable = 0;
    EXPECT_FALSE(stander.pushed_by({0.05F, 0})) << reason;
  }
}

// With a wrong estimate it would trot for ever.
TEST(SteppingWherePushed, TakesAFewStepsAndStandsAgain) {
  Stander stander;
  ASSERT_TRUE(stander.pushed_by({0.05F, 0}));
  int landings = 0, ticks = 0;
  for (std::uint32_t swing = gait::kBoth; ticks < 400; ++ticks) {
    stander.tick({});
    const std::uint32_t now = stander.walker.state.queue[0].swing;
    if (stander.walker.state.queued == 0) break;
    if (swing != gait::kBoth && now != swing) ++landings;
    swing = now;
  }
  EXPECT_GE(landings, 3);
  EXPECT_LE(landings, 6);
  EXPECT_LT(ticks, 250);
  EXPECT_FALSE(stander.steps);
  EXPECT_EQ(int{stander.walker.state.queued}, 0);
}

TEST(SteppingWherePushed, AStepFarOffItsPlanIsFollowedByMore) {
  Stander stander;
  ASSERT_TRUE(stander.pushed_by({0.05F, 0}));
  for (int i = 0; i < 400; ++i) stander.tick({0.05F, 0});
  EXPECT_TRUE(stander.steps);
  EXPECT_GT(int{stander.walker.state.queued}, 0);
}

}  // namespace
}  // namespace verp::balance
