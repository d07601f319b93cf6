#include "common/gait/footsteps.hpp"

#include <gtest/gtest.h>

#include "common/gait/swing.hpp"
#include "tests/unit/gait/steps.hpp"

namespace verp::gait {
namespace {

using test::kRobot;
using test::kSteps;
using test::Walk;

float side_of(int foot) {
  return foot == kLeft ? 1.0F : -1.0F;
}

Xy landing_from_carrying(const Step& step) {
  const Foothold& carrying = step.foot[step.carrying()];
  return turned(step.landing.at_m - carrying.at_m, -carrying.yaw_rad);
}

TEST(Footsteps, FirstStepShiftsTheWeightAndLiftsNoFoot) {
  Walk walk;
  EXPECT_EQ(int{walk.last.swing}, int{kBoth});
  EXPECT_TRUE(walk.last.phase == Phase::kStart);
  EXPECT_NEAR(walk.last.zmp_begin_m.y, 0.0F, 1e-7F);
  EXPECT_LT(walk.last.zmp_end_m.y, 0.0F) << "over the right foot";
  EXPECT_NEAR(walk.last.duration_s(), walk.tuning.start_s, walk.last.key_s());
}

TEST(Footsteps, FeetTakeTurns) {
  Walk walk;
  for (int i = 0; i < kSteps; ++i) {
    const Step& step = walk.take({.vx_m_s = 0.1F});
    EXPECT_EQ(int{step.swing}, i % 2 == 0 ? int{kLeft} : int{kRight});
    EXPECT_EQ(step.key_points, kKeyPointsPerStep);
    const float half_period_s = i % 4 == 3 ? 0.5e-6F * static_cast<float>(kRobot.period_us) : 0.0F;
    EXPECT_NEAR(math::abs(step.duration_s() - 0.5F * walk.tuning.cycle_s), half_period_s, 1e-4F);
  }
}

// The gyro is read once per period and must not always see the same moment of a landing.
TEST(Footsteps, EachFootLandsInBothHalvesOfAControlPeriod) {
  Walk walk;
  walk.tuning.cycle_s = 0.45F;
  const auto period_us = static_cast<std::int32_t>(kRobot.period_us);
  std::int32_t at_us = 0;
  Xy sum[kFeet];
  constexpr int kTaken = 32;
  for (int i = 0; i < kTaken; ++i) {
    const Step& step = walk.take({.vx_m_s = 0.1F});
    at_us += step.duration_us();
    const float turn_rad =
        2.0F * math::kPi * static_cast<float>(at_us % period_us) / static_cast<float>(period_us);
    const math::SinCos moment = math::sincos(turn_rad);
    sum[step.swing] = sum[step.swing] + Xy{moment.cos, moment.sin};
  }
  EXPECT_EQ(at_us, kTaken * 225000) << "the cycle is as long as is asked";
  for (const Xy& each : sum) EXPECT_LT(math::hypot(each.x, each.y), 0.1F);
}

TEST(Footsteps, WithoutAHeadingToKeepAllStepsLastEquallyLong) {
  Walk walk;
  walk.tuning.heading_gain = 0.0F;
  for (int i = 0; i < kSteps; ++i) {
    EXPECT_NEAR(walk.take({.vx_m_s = 0.1F}).duration_s(), 0.5F * walk.tuning.cycle_s, 1e-4F);
  }
}

TEST(Footsteps, TheSwingFootLiftsAsHighAsIsTunedAndTheOtherStands) {
  Walk walk;
  for (int i = 0; i < 6; ++i) {
    const Step& step = walk.take({.vx_m_s = 0.1F});
    float highest_m = 0;
    for (int k = 0; k <= 50; ++k) {
      const float time_s = 0.02F * static_cast<float>(k) * step.duration_s();
      highest_m = math::max(highest_m, foot_at(step, step.swing, time_s).height_m);
      EXPECT_LE(foot_at(step, step.carrying(), time_s).height_m, walk.tuning.touchdown_m);
    }
    EXPECT_GT(highest_m, 0.95F * walk.tuning.lift_m);
    EXPECT_LT(highest_m, 1.05F * walk.tuning.lift_m + walk.tuning.touchdown_m);
  }
}

// At 0.42 m/s a sagging robot's foot would scrape.
TEST(Footsteps, AHurriedFootLiftsHigherAndStartsSooner) {
  Walk slow, fast;
  slow.tuning.max_step_m = fast.tuning.max_step_m = 0.1F;
  for (int i = 0; i < kSteps; ++i) {
    slow.take({.vx_m_s = 0.17F});
    fast.take({.vx_m_s = 0.42F});
  }
  EXPECT_EQ(slow.last.haste, 0.0F);
  EXPECT_EQ(slow.last.lift_m, slow.tuning.lift_m);
  EXPECT_NEAR(fast.last.haste, 1.07F, 0.05F);
  EXPECT_EQ(slow.last.touchdown_m, slow.tuning.touchdown_m);
  EXPECT_EQ(fast.last.touchdown_m, 0.75F * fast.tuning.touchdown_m) << "and comes down sooner";
  EXPECT_EQ(fast.last.lift_m, fast.tuning.lift_m + fast.tuning.haste_lift_m * fast.last.haste);
  float fastest_slow = 0, fastest_fast = 0;
  for (int i = 0; i <= 64; ++i) {
    const float u = static_cast<float>(i) / 64.0F;
    fastest_slow = math::max(fastest_slow, swing_along(u, slow.last.haste).derivative);
    fastest_fast = math::max(fastest_fast, swing_along(u, fast.last.haste).derivative);
  }
  EXPECT_EQ(fastest_slow, 1.875F);
  EXPECT_LT(fastest_fast, 1.8F) << "of the mean speed";
  EXPECT_EQ(swing_along(0.0F, fast.last.haste).value, 0.0F);
  EXPECT_EQ(swing_along(1.0F, fast.last.haste).value, 1.0F);
}

TEST(Footsteps, PlanHasNoGaps) {
  Walk walk;
  for (int i = 0; i < kSteps; ++i) {
    const Step before = walk.last;
    const Step& step = walk.take({.vx_m_s = 0.15F, .vy_m_s = 0.02F, .wz_rad_s = 0.3F});
    for (int foot = 0; foot < kFeet; ++foot) {
      EXPECT_EQ(step.foot[foot].at_m.x, before.after(foot).at_m.x);
      EXPECT_EQ(step.foot[foot].at_m.y, before.after(foot).at_m.y);
      EXPECT_EQ(step.foot[foot].yaw_rad, before.after(foot).yaw_rad);
    }
    EXPECT_EQ(step.zmp_begin_m.x, before.zmp_end_m.x);
    EXPECT_EQ(step.zmp_begin_m.y, before.zmp_end_m.y);
    EXPECT_EQ(int{step.landed}, int{before.swing});
    EXPECT_EQ(step.settle_m, before.touchdown_m);
  }
}

TEST(Footsteps, VelocityBecomesStride) {
  for (const float vx : {-0.1F, 0.0F, 0.08F, 0.1777F}) {
    Walk walk;
    for (int i = 0; i < kSteps; ++i) walk.take({.vx_m_s = vx});
    const Xy way = landing_from_carrying(walk.last);
    EXPECT_NEAR(way.x, vx * 0.5F * walk.tuning.cycle_s, 1e-6F);
    EXPECT_NEAR(way.y, side_of(walk.last.swing) * 2 * walk.tuning.half_stance_m, 1e-6F);
    EXPECT_EQ(walk.state.notes, 0u);
    EXPECT_TRUE(walk.last.phase == Phase::kTransition);
  }
}

TEST(Footsteps, StridesGrowByAtMostTheTunedChange) {
  Walk walk;
  float before_m = 0;
  for (int i = 0; i < kSteps; ++i) {
    walk.take({.vx_m_s = i < kSteps / 2 ? 0.3F : -0.3F});
    EXPECT_LE(math::abs(walk.state.stride.by_m.x - before_m), walk.tuning.step_change_m + 1e-7F);
    before_m = walk.state.stride.by_m.x;
  }
  EXPECT_LT(before_m, 0.0F);
}

TEST(Footsteps, TooFastIsLimitedAndNoted) {
  Walk walk;
  for (int i = 0; i < kSteps; ++i) walk.take({.vx_m_s = 5.0F, .vy_m_s = -3.0F, .wz_rad_s = 20.0F});
  EXPECT_NE(walk.state.notes & kStrideLimited, 0u);
  const Stride& stride = walk.state.stride;
  EXPECT_LE(math::hypot(stride.by_m.x, 2 * stride.by_m.y), walk.tuning.max_step_m + 1e-6F);
  EXPECT_LE(math::abs(stride.turn_rad), walk.tuning.max_turn_rad + 1e-6F);
}

TEST(Footsteps, NoStepIsLongerThanTheLongestAdmittedOnTheWayToAnother) {
  test::Random random(5);
  Walk walk;
  for (int turn = 0; turn < 40; ++turn) {
    const VelocityIn wanted{.vx_m_s = random.between(-0.5F, 0.5F),
                            .vy_m_s = random.between(-0.3F, 0.3F)};
    for (int i = 0; i < 8; ++i) {
      walk.take(wanted);
      const Stride& stride = walk.state.stride;
      EXPECT_LE(math::hypot(stride.by_m.x, 2 * stride.by_m.y), walk.tuning.max_step_m + 1e-6F);
    }
    for (int i = 0; i < 16; ++i) walk.take(wanted);
    EXPECT_TRUE(walk.last.phase == Phase::kTransition) << "it gets there";
  }
}

TEST(Footsteps, StepsBeyondTheLegsReachAreShortenedAndNoted) {
  Walk walk;
  walk.tuning.hip_height_m = 0.185F;
  walk.tuning.max_step_m = 0.3F;
  for (int i = 0; i < kSteps; ++i) walk.take({.vx_m_s = 1.0F});
  EXPECT_NE(walk.state.notes & kReachShortened, 0u);
  EXPECT_LT(walk.state.stride.by_m.x, 0.06F);
}

TEST(Footsteps, ReachIsTheSameInEveryDirection) {
  const VelocityIn ways[] = {{.vx_m_s = 1.0F},
                             {.vx_m_s = -1.0F},
                             {.vy_m_s = 1.0F},
                             {.vy_m_s = -1.0F},
                             {.vx_m_s = 1.0F, .vy_m_s = 0.5F}};
  float longest_m = 0;
  for (const VelocityIn& way : ways) {
    Walk walk;
    walk.tuning.hip_height_m = 0.185F;
    walk.tuning.max_step_m = 0.3F;
    for (int i = 0; i < kSteps; ++i) walk.take(way);
    const Stride& stride = walk.state.stride;
    const float length_m = math::hypot(stride.by_m.x, 2 * stride.by_m.y);
    if (longest_m == 0) longest_m = length_m;
    EXPECT_NEAR(length_m, longest_m, 1e-6F) << way.vx_m_s << ", " << way.vy_m_s;
    EXPECT_NE(walk.state.notes & kReachShortened, 0u);
    EXPECT_TRUE(walk.last.phase == Phase::kTransition) << "the longest stride is steady too";
  }
}

TEST(Footsteps, LeadingFootOpensTheOtherCloses) {
  for (const float sign : {1.0F, -1.0F}) {
    Walk walk;
    for (int i = 0; i < kSteps; ++i) {
      const Step& step = walk.take({.vy_m_s = sign * 0.06F, .wz_rad_s = sign * 0.3F});
      const bool leads = side_of(step.swing) == sign;
      const float apart_m = math::abs(landing_from_carrying(step).y);
      EXPECT_GE(apart_m, 2 * walk.tuning.half_stance_m - 1e-4F) << "step " << i;
      const float turn_rad = step.landing.yaw_rad - step.foot[step.carrying()].yaw_rad;
      if (leads) {
        if (i < 3) continue;  // still growing
        EXPECT_GT(apart_m, 2 * walk.tuning.half_stance_m + 0.01F);
        EXPECT_GT(sign * turn_rad, 0.0F);
      } else {
        EXPECT_NEAR(turn_rad, 0.0F, 1e-6F);
      }
    }
  }
}

TEST(Footsteps, HeadingErrorTurnsTheNextSteps) {
  Walk walk;
  for (int i = 0; i < 4; ++i) walk.take({.vx_m_s = 0.1F, .heading_error_rad = 0.1F});
  EXPECT_GT(walk.state.body.yaw_rad, 0.02F);
  EXPECT_LT(walk.state.body.yaw_rad, 0.4F);
}

TEST(Footsteps, StopBringsTheFeetLevelThenTheWeightBack) {
  for (const VelocityIn& wanted :
       {VelocityIn{.vx_m_s = 0.3F}, VelocityIn{.vx_m_s = -0.1F, .vy_m_s = 0.05F},
        VelocityIn{.vx_m_s = 0.1F, .wz_rad_s = -0.5F}}) {
    Walk walk;
    for (int i = 0; i < kSteps; ++i) walk.take(wanted);
    VelocityIn stop = wanted;
    stop.stop = true;
    int steps = 0;
    while (walk.take(stop).swing != kBoth) {
      EXPECT_TRUE(walk.last.phase == Phase::kFinal);
      ASSERT_LT(++steps, 15);
    }
    EXPECT_TRUE(walk.last.phase == Phase::kFinal);
    const Foothold &left = walk.last.foot[kLeft], &right = walk.last.foot[kRight];
    EXPECT_NEAR(left.yaw_rad, right.yaw_rad, 1e-6F);
    const Xy apart = turned(left.at_m - right.at_m, -left.yaw_rad);
    EXPECT_NEAR(apart.x, 0.0F, 1e-5F);
    EXPECT_NEAR(apart.y, 2 * walk.tuning.half_stance_m, 1e-5F);
    const Xy middle = 0.5F * (left.at_m + right.at_m);
    EXPECT_NEAR(walk.last.zmp_end_m.x, middle.x, 1e-6F);
    EXPECT_NEAR(walk.last.zmp_end_m.y, middle.y, 1e-6F);
  }
}

TEST(Footsteps, QuickStopClosesTheFeetInTheNextStepOrNarrowsThemInOneMore) {
  for (const VelocityIn& wanted :
       {VelocityIn{.vx_m_s = 0.42F}, VelocityIn{.vx_m_s = -0.1F, .vy_m_s = 0.2F},
        VelocityIn{.vx_m_s = 0.1F, .wz_rad_s = -1.5F}}) {
    Walk walk;
    for (int i = 0; i < kSteps; ++i) walk.take(wanted);
    VelocityIn stop = wanted;
    stop.stop = stop.quick = true;
    EXPECT_NE(walk.take(stop).swing, kBoth);
    const bool wide = (walk.state.notes & kStepWidened) != 0;
    if (wide) walk.take(stop);
    EXPECT_EQ(walk.take(stop).swing, kBoth);
  }
}

TEST(Footsteps, AStepThatIsTakenBackIsPlannedAgain) {
  for (const VelocityIn& wanted :
       {VelocityIn{.vx_m_s = 0.3F}, VelocityIn{.vx_m_s = -0.1F, .vy_m_s = 0.1F},
        VelocityIn{.vx_m_s = 0.1F, .wz_rad_s = -0.5F}}) {
    Walk walk;
    for (int i = 0; i < kSteps; ++i) walk.take(wanted);
    const Step before = walk.last;
    const Step once = walk.take(wanted);
    take_back(walk.tuning, once, walk.state);
    walk.last = before;
    const Step again = walk.take(wanted);
    EXPECT_NEAR(again.landing.at_m.x, once.landing.at_m.x, 1e-6F);
    EXPECT_NEAR(again.landing.at_m.y, once.landing.at_m.y, 1e-6F);
    EXPECT_NEAR(again.landing.yaw_rad, once.landing.yaw_rad, 1e-6F);
    EXPECT_EQ(again.key_us, once.key_us);
  }
}

TEST(Footsteps, ZmpStaysInsideTheSoleWhateverIsTuned) {
  GaitTuning tuning;
  for (const float x : {-0.05F, 0.0F, 0.05F}) {
    for (const float y : {-0.05F, 0.0F, 0.05F}) {
      for (const float margin : {0.0F, 0.01F, 0.03F}) {
        tuning.zmp_x_m = x;
        tuning.zmp_y_m = y;
        tuning.support_margin_m = margin;
        const Foothold foot{{0.3F, -0.1F}, 0.5F};
        for (int side = 0; side < kFeet; ++side) {
          const Xy in_sole = turned(zmp_under(kRobot, tuning, side, foot) - foot.at_m, -0.5F);
          EXPECT_LE(math::abs(in_sole.x), 0.052F - margin + 1e-6F);
          EXPECT_LE(math::abs(in_sole.y), 0.033F - margin + 1e-6F);
        }
      }
    }
  }
}

// Outward from the midline.
TEST(Footsteps, ZmpUnderBothFeetIsMirrored) {
  GaitTuning tuning;
  const Xy left = zmp_under(kRobot, tuning, kLeft, {{0, 0.036F}, 0});
  const Xy right = zmp_under(kRobot, tuning, kRight, {{0, -0.036F}, 0});
  EXPECT_EQ(left.x, right.x);
  EXPECT_EQ(left.y, -right.y);
}

TEST(Footsteps, StepsOfAnyTimesLastAndKeepTheirTimesIfTheyCan) {
  for (const float cycle_s : {0.0F, 1e-6F, 0.2F, 0.45F, 1.5F}) {
    for (const float start_s : {0.0F, 0.4F, 3.0F, 1000.0F}) {
      GaitTuning tuning;
      tuning.cycle_s = cycle_s;
      tuning.start_s = start_s;
      const Step step = standing_feet(kRobot, tuning);
      EXPECT_NEAR(step.key_us, math::max(1.0F, 1e6F * cycle_s / (2 * kKeyPointsPerStep)), 1.0F);
      EXPECT_GE(step.key_us, 1);
      const double points = start_s / (1e-6 * step.key_us);
      EXPECT_NEAR(step.key_points, points < 15 ? 15 : points > 250 ? 250 : points, 1.0) << cycle_s;
    }
  }
}

TEST(Footsteps, RestingWeightIsInTheMiddleOfLopsidedSoles) {
  Params params = test::make_robot();
  for (LegParams& leg : params.leg) leg.sole_front_m = 0.08F;
  params.leg[kLeft].sole_left_m = 0.05F;
  const Step stand = standing_feet(params, GaitTuning{});
  EXPECT_NEAR(stand.zmp_end_m.x, 0.5F * (0.08F - 0.052F), 1e-6F);
  EXPECT_NEAR(stand.zmp_end_m.y, 0.25F * (0.05F - 0.033F), 1e-6F);
  const Xy left = zmp_under(params, GaitTuning{}, kLeft, {{1, 2}, math::kHalfPi});
  EXPECT_NEAR(left.x, 1 - 0.5F * (0.05F - 0.033F) - GaitTuning{}.zmp_y_m, 1e-6F);
  EXPECT_NEAR(left.y, 2 + 0.5F * (0.08F - 0.052F) + GaitTuning{}.zmp_x_m, 1e-6F);
}

}  // namespace
}  // namespace verp::gait
