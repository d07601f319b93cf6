#include "common/gait/gait.hpp"

#include <gtest/gtest.h>

#include "common/model/tuning_ranges.hpp"
#include "tests/unit/gait/walker.hpp"

namespace verp::gait {
namespace {

using test::apart;
using test::Walker;

constexpr float kPaper_m_s = 0.1777F;  // 4 cm steps, 450 ms

// Both feet relative to the body, in one tick.
float largest_move(const Pose* before, const Walker& walker) {
  return math::max(test::distance(before[kLeft].position_m, walker.sole(kLeft).position_m),
                   test::distance(before[kRight].position_m, walker.sole(kRight).position_m));
}

// A quintic peaks at 15/8 of its mean; a swing foot travels at most twice its step.
float fastest_m_s(float velocity_m_s) {
  return 0.25F + 4.5F * math::abs(velocity_m_s);
}

TEST(Gait, WholeWalkIsContinuousAndItsPhasesFollowEachOther) {
  Walker walker(test::kRobot);
  walker.set_off({.vx_m_s = kPaper_m_s});
  const float height_m = walker.out.posture.body.position_m.z();
  constexpr Phase kOrder[] = {Phase::kIdle, Phase::kStart, Phase::kTransition, Phase::kFinal,
                              Phase::kIdle};
  int phase = 0;
  for (int i = 0; i < 2000; ++i) {
    if (i == 1700) walker.in.walk = false;
    const Pose before[] = {walker.sole(kLeft), walker.sole(kRight)};
    walker.tick();
    if (walker.out.phase != kOrder[phase]) ++phase;
    ASSERT_LT(phase, 5) << "tick " << i;
    ASSERT_TRUE(walker.out.phase == kOrder[phase]) << "tick " << i;
    ASSERT_LT(largest_move(before, walker), 0.01F * fastest_m_s(kPaper_m_s)) << "tick " << i;
    ASSERT_NEAR(walker.out.posture.body.position_m.z(), height_m, 1e-6F) << "body height";
  }
  EXPECT_EQ(phase, 4);
  EXPECT_EQ(int{walker.state.queued}, 0);
}

// Weighing takes most of a standing tick. A lump without mass shows whether it ran.
TEST(Gait, StandsUnweighedUntilSomethingMoves) {
  Walker walker(test::kRobot);
  walker.run(1.5F);
  const Lump known = walker.state.preview.lump;
  const auto weighs = [&] {
    walker.state.preview.lump = Lump{};
    walker.tick();
    const bool weighed = walker.state.preview.lump.mass_kg == known.mass_kg;
    walker.run(1.5F);
    return weighed;
  };
  const Xy rest_m = walker.state.stand_body_m;
  EXPECT_FALSE(weighs());
  EXPECT_EQ(apart(walker.state.stand_body_m, rest_m), 0.0F);
  walker.goal_rad[test::kLeftArm] += 0.5F;
  EXPECT_TRUE(weighs());
  EXPECT_GT(apart(walker.state.stand_body_m, rest_m), 1e-4F);
  EXPECT_FALSE(weighs());
  walker.tuning.gait.trunk_pitch_rad += 0.01F;
  EXPECT_TRUE(weighs());
  EXPECT_FALSE(weighs());
  walker.state.stand_body_m.x += 0.001F;
  EXPECT_TRUE(weighs());
  walker.in.walk = true;
  EXPECT_TRUE(weighs());
}

TEST(Gait, StandsWhereWeighingInEveryTickWouldHaveIt) {
  Walker one(test::kRobot), other(test::kRobot);
  for (int i = 0; i < 300; ++i) {
    other.state.settled = Settled{};
    if (i == 150) one.goal_rad[test::kHead] = other.goal_rad[test::kHead] = 0.4F;
    one.tick();
    other.tick();
    ASSERT_EQ(apart(one.state.stand_body_m, other.state.stand_body_m), 0.0F) << "tick " << i;
  }
}

TEST(Gait, VelocityChangesInMidWalkAreContinuous) {
  constexpr VelocityIn kOrders[] = {{.vx_m_s = 0.15F},
                                    {.vx_m_s = -0.1F},
                                    {.vx_m_s = 0.05F, .vy_m_s = 0.05F},
                                    {.vy_m_s = -0.06F, .wz_rad_s = 0.5F},
                                    {.wz_rad_s = -0.5F},
                                    {.vx_m_s = 0.3F}};
  Walker walker(test::kRobot);
  walker.set_off({});
  for (int i = 0; i < 1200; ++i) {
    walker.in.wanted = kOrders[i / 200];
    const Pose before[] = {walker.sole(kLeft), walker.sole(kRight)};
    walker.tick();
    ASSERT_LT(largest_move(before, walker), 0.015F) << "tick " << i;
    ASSERT_LT(test::turn_between(before[kLeft].rotation, walker.sole(kLeft).rotation), 0.06F);
  }
  EXPECT_TRUE(walker.out.phase == Phase::kTransition);
}

TEST(Gait, SteadyWalkGoesAtTheVelocityWanted) {
  Walker walker(test::kRobot);
  walker.set_off({.vx_m_s = kPaper_m_s});
  walker.run(3.0F);
  float way_m = 0;
  constexpr int kTicks = 450;  // ten cycles
  for (int i = 0; i < kTicks; ++i) {
    const Pose before = walker.sole(kLeft);
    const bool carried = walker.state.queue[0].swing == kRight;
    walker.tick();
    if (carried && walker.state.queue[0].swing == kRight) {
      way_m += before.position_m.x() - walker.sole(kLeft).position_m.x();
    }
  }
  EXPECT_NEAR(way_m, 0.5F * kPaper_m_s * 0.01F * kTicks, 0.06F);
}

TEST(Gait, RightStepsMirrorLeftSteps) {
  constexpr int kTicksPerStep = 45;
  Walker walker(test::kRobot, 5000);
  walker.tuning.gait.heading_gain = 0.0F;  // steps last equally long
  walker.set_off({.vx_m_s = kPaper_m_s});
  walker.run(6.0F);
  static Pose sole[kTicksPerStep][kFeet];
  for (int i = 0; i < 2 * kTicksPerStep; ++i) {
    walker.tick();
    for (int side = 0; side < kFeet; ++side) {
      if (i < kTicksPerStep) {
        sole[i][side] = walker.sole(side);
      } else {
        const Pose other = test::mirrored(sole[i - kTicksPerStep][1 - side]);
        EXPECT_LT(test::distance(walker.sole(side).position_m, other.position_m), 2e-5F) << i;
        EXPECT_LT(test::turn_between(walker.sole(side).rotation, other.rotation), 1e-3F) << i;
      }
    }
  }
}

// The error is how far the head was ahead when a key point was fixed.
TEST(Gait, AnyPeriodGivesTheSameWalk) {
  constexpr int kSamples = 100;  // every 40 ms
  static Pose wanted[kSamples][kFeet];
  for (const std::int32_t period_us : {10000, 4000, 5000, 8000, 20000}) {
    Walker walker(test::kRobot, period_us);
    walker.set_off({.vx_m_s = kPaper_m_s});
    while (walker.state.moving == 0) walker.tick();
    ASSERT_EQ(walker.state.clock_us, 0);
    for (int sample = 0; sample < kSamples; ++sample) {
      walker.run(0.04F);
      for (int side = 0; side < kFeet; ++side) {
        if (period_us == 10000) wanted[sample][side] = walker.sole(side);
        EXPECT_LT(test::distance(walker.sole(side).position_m, wanted[sample][side].position_m),
                  5e-5F)
            << period_us << " us, sample " << sample;
      }
    }
  }
}

// To a sole's rectangle; 0 inside.
float outside_of(const LegParams& leg, const Foothold& foot, Xy point_m) {
  const Xy at = turned(point_m - foot.at_m, -foot.yaw_rad);
  const float x = math::max(at.x - leg.sole_front_m, -leg.sole_back_m - at.x);
  const float y = math::max(at.y - leg.sole_left_m, -leg.sole_right_m - at.y);
  return math::hypot(math::max(x, 0.0F), math::max(y, 0.0F));
}

// By the margin in single support, between the points under both feet in double support.
TEST(Gait, PlannedZmpStaysInsideTheSupportPolygon) {
  constexpr VelocityIn kOrders[] = {
      {.vx_m_s = kPaper_m_s}, {.vx_m_s = -0.1F, .vy_m_s = 0.05F}, {.wz_rad_s = 0.6F}};
  for (const VelocityIn& order : kOrders) {
    Walker walker(test::kRobot);
    walker.tuning.gait.double_support = 0.3F;
    walker.set_off(order);
    for (int i = 0; i < 500; ++i) {
      walker.tick();
      if (walker.state.queued == 0) continue;
      const Step& step = walker.state.queue[0];
      const Xy zmp_m = walker.out.zmp_m;
      const float left_m = outside_of(test::kRobot.leg[kLeft], step.foot[kLeft], zmp_m);
      const float right_m = outside_of(test::kRobot.leg[kRight], step.foot[kRight], zmp_m);
      if (step.swing != kBoth &&
          static_cast<float>(walker.state.clock_us) * 1e-6F >= step.double_support_s) {
        ASSERT_EQ(step.swing == kLeft ? right_m : left_m, 0.0F) << "tick " << i;
      } else {
        const float gap_m = apart(step.foot[kLeft].at_m, step.foot[kRight].at_m);
        ASSERT_LT(left_m + right_m, gap_m) << "tick " << i;
      }
    }
  }
}

TEST(Gait, WeightIsSharedAndGoesToTheCarryingFoot) {
  Walker walker(test::kRobot);
  walker.set_off({.vx_m_s = 0.1F});
  for (int i = 0; i < 500; ++i) {
    walker.tick();
    EXPECT_NEAR(walker.out.carry[kLeft] + walker.out.carry[kRight], 1.0F, 1e-6F);
    for (int side = 0; side < kFeet; ++side) {
      EXPECT_GE(walker.out.carry[side], 0.0F);
      if (walker.out.posture.foot[side].height_m > walker.tuning.gait.touchdown_m + 1e-4F) {
        EXPECT_EQ(walker.out.carry[side], 0.0F);
      }
    }
  }
}

TEST(Gait, AFootThatLandedTakesTheWeightOverInNoLessThanEightMilliseconds) {
  for (const float double_support : {0.0F, 0.006F, 0.2F}) {
    Walker walker(test::kRobot);
    walker.tuning.gait.double_support = double_support;
    walker.in.period_us = 4000;
    walker.set_off({.vx_m_s = 0.1F});
    int between = 0;
    for (int i = 0; i < 1000; ++i) {
      const float before = walker.out.carry[kLeft];
      walker.tick();
      const float taken = walker.out.carry[kLeft] - before;
      ASSERT_LT(math::abs(taken), 0.51F) << "tick " << i << ", double support " << double_support;
      if (walker.out.carry[kLeft] > 0.0F && walker.out.carry[kLeft] < 1.0F) ++between;
    }
    EXPECT_GT(between, 10);
  }
}

Walker walked(float step_m, float cycle_s, float multibody_enable, float lift_m = 0.0119F) {
  Walker walker(test::kRobot);
  walker.tuning.balance.multibody_enable = multibody_enable;
  walker.tuning.gait.cycle_s = cycle_s;
  walker.tuning.gait.max_step_m = 0.3F;
  walker.tuning.gait.lift_m = lift_m;
  walker.set_off({.vx_m_s = 2.0F * step_m / cycle_s});
  walker.run(6.0F);
  return walker;
}

TEST(Gait, PlanWhoseZmpWouldLeaveTheSoleIsShortenedOrRefused) {
  for (const float multibody : {0.0F, 1.0F}) {
    const Walker paper = walked(0.04F, 0.45F, multibody);
    EXPECT_EQ(paper.state.footsteps.notes, 0U);
    EXPECT_NEAR(paper.state.footsteps.stride.by_m.x, 0.04F, 1e-4F);

    const Walker longer = walked(0.12F, 0.45F, multibody);
    EXPECT_TRUE((longer.state.footsteps.notes & kZmpShortened) != 0);
    EXPECT_FALSE((longer.state.footsteps.notes & kPlanRefused) != 0);
    EXPECT_LT(longer.state.footsteps.stride.by_m.x, 0.11F);
    EXPECT_GT(longer.state.footsteps.stride.by_m.x, 0.01F);

    const Walker too_fast = walked(0.2F, 0.3F, multibody);
    EXPECT_TRUE((too_fast.state.footsteps.notes & kZmpShortened) != 0);
    EXPECT_LT(too_fast.state.footsteps.scale, 0.3F);

    const Walker absurd = walked(0.2F, 0.3F, multibody, 0.05F);
    EXPECT_TRUE((absurd.state.footsteps.notes & kPlanRefused) != 0);
    EXPECT_TRUE(absurd.out.phase == Phase::kIdle) << "it stands";
  }
}

// A slower walk or more margin ends the shortening.
TEST(Gait, ShortenedPlanGrowsAgainWhenThereIsRoomAndOnlyThen) {
  Walker walker = walked(0.12F, 0.45F, 1.0F);
  walker.run(20.0F);
  const float shortened = walker.state.footsteps.scale;
  EXPECT_LT(shortened, 0.95F);
  float least = 1, most = 0;
  for (int i = 0; i < 1000; ++i) {
    walker.tick();
    least = math::min(least, walker.state.footsteps.scale);
    most = math::max(most, walker.state.footsteps.scale);
  }
  EXPECT_EQ(least, most) << "a steady walk's strides do not hunt";
  walker.in.wanted.vx_m_s = 0.1F;
  walker.run(10.0F);
  EXPECT_EQ(walker.state.footsteps.scale, 1.0F);
  EXPECT_NEAR(walker.state.footsteps.stride.by_m.x, 0.1F * 0.5F * 0.45F, 1e-6F);
}

TEST(Gait, CycleStatesCountFromZeroToFifteen) {
  Walker walker(test::kRobot, 5000);
  walker.set_off({.vx_m_s = 0.1F});
  walker.run(3.0F);
  std::uint32_t seen = 0;
  for (int i = 0; i < 180; ++i) {  // two cycles
    const int before = walker.out.cycle_state;
    walker.tick();
    const int now = walker.out.cycle_state;
    EXPECT_TRUE(now == before || now == before + 1 || now < 2) << before << " to " << now;
    ASSERT_LT(now, 16);
    seen |= 1u << now;
  }
  EXPECT_EQ(seen, 0xFFFFu);
}

TEST(Gait, WalksAgainAfterStopping) {
  Walker walker(test::kRobot);
  for (int walk = 0; walk < 3; ++walk) {
    walker.set_off({.vx_m_s = 0.1F, .wz_rad_s = 0.2F});
    walker.run(2.0F);
    EXPECT_NE(int{walker.state.queued}, 0);
    walker.in.walk = false;
    walker.run(4.0F);
    EXPECT_EQ(int{walker.state.queued}, 0);
    EXPECT_TRUE(walker.out.phase == Phase::kIdle);
  }
}

TEST(Gait, StopBeforeTheFirstStepIsHonoured) {
  for (int ticks = 1; ticks < 80; ticks += 7) {
    Walker walker(test::kRobot);
    walker.set_off({.vx_m_s = 0.1F});
    for (int i = 0; i < ticks; ++i) walker.tick();
    walker.in.walk = false;
    walker.run(4.0F);
    EXPECT_EQ(int{walker.state.queued}, 0) << "stopped after " << ticks;
  }
}

// However short the cycle, no overwritten key point is read.
TEST(Gait, DelayedJointsSeeTheRecentPast) {
  constexpr int kTicks = 400;
  static Vec3 sole_m[kTicks];
  for (const float cycle_s : {0.30F, 0.45F, 1.0F}) {
    Walker walker(test::kRobot);
    walker.tuning.gait.cycle_s = cycle_s;
    walker.set_off({.vx_m_s = 0.1F});
    for (int tick = 0; tick < kTicks; ++tick) {
      walker.tick();
      sole_m[tick] = walker.sole(kLeft).position_m;
      if (walker.state.moving == 0 || tick < 60) continue;
      // The previous step's key points may lie closer together.
      constexpr std::int32_t kKept = kFixed - 4;
      const std::int32_t key_us = walker.state.queue[0].key_us, clock_us = walker.state.clock_us;
      const std::int32_t passed = clock_us / key_us;
      const std::int32_t both_us = clock_us + (kKept - passed) * walker.state.previous.key_us;
      const std::int32_t kept_us =
          passed >= kKept || both_us > kKept * key_us ? kKept * key_us : both_us;
      for (int back = 0; back <= 15; ++back) {
        const std::int32_t delay_us = back * walker.in.period_us;
        if (delay_us > kept_us) break;
        const Posture then = posture_before(test::kRobot, walker.tuning, walker.state, delay_us);
        EXPECT_LT(test::distance(sole_in_body(then, kLeft).position_m, sole_m[tick - back]), 1e-5F)
            << "cycle " << cycle_s << ", tick " << tick << ", " << delay_us << " us before";
      }
      const Posture oldest = posture_before(test::kRobot, walker.tuning, walker.state, kept_us);
      const Posture beyond = posture_before(test::kRobot, walker.tuning, walker.state, 150000);
      if (kept_us > 150000) continue;
      EXPECT_EQ(oldest.body.position_m.x(), beyond.body.position_m.x());
      EXPECT_EQ(oldest.body.position_m.y(), beyond.body.position_m.y());
    }
  }
}

TEST(Gait, DelaysAddUpSmoothly) {
  Walker walker(test::kRobot);
  walker.set_off({.vx_m_s = 0.1F});
  walker.run(2.0F);
  const Posture now = posture_before(test::kRobot, walker.tuning, walker.state, 0);
  EXPECT_LT(test::distance(now.body.position_m, walker.out.posture.body.position_m), 1e-7F);
  Posture later = now;
  for (std::int32_t delay_us = 5000; delay_us <= 150000; delay_us += 5000) {
    const Posture then = posture_before(test::kRobot, walker.tuning, walker.state, delay_us);
    EXPECT_LT(test::distance(then.body.position_m, later.body.position_m), 5e-3F) << delay_us;
    later = then;
  }
}

void expect_total(const Tuning& tuning, const VelocityIn& wanted, int what) {
  Walker walker(test::kRobot, 20000);
  walker.tuning = tuning;
  walker.set_off({});
  walker.in.wanted = wanted;
  for (int i = 0; i < 100; ++i) {
    if (i == 80) walker.in.walk = false;
    walker.tick();
    ASSERT_TRUE(test::struct_is_finite(walker.state)) << "tuning " << what << ", tick " << i;
    ASSERT_LE(int{walker.state.queued}, kQueue);
    ASSERT_TRUE(math::is_finite(walker.out.posture.body.position_m)) << "tuning " << what;
    for (int side = 0; side < kFeet; ++side) {
      const Pose sole = walker.sole(side);
      ASSERT_TRUE(math::is_finite(sole.position_m)) << "tuning " << what << ", tick " << i;
      ASSERT_LT(math::norm(sole.position_m), 100.0F) << "tuning " << what << ", tick " << i;
    }
  }
}

// The hip is too high.
TEST(Gait, WalkIsRefusedWhereTheLegsDontReachTheFloor) {
  Walker walker(test::kRobot);
  walker.tuning.gait.hip_height_m = 0.21F;
  walker.set_off({.vx_m_s = 0.1F});
  walker.run(3.0F);
  EXPECT_EQ(walker.state.queued, 0);
  EXPECT_NE(walker.state.footsteps.notes & kPlanRefused, 0);
}

TEST(Gait, EndsOfEveryTuningRangeGiveFinitePlans) {
  for (int id = 0; id < kTuningCount && id < static_cast<int>(sizeof(GaitTuning) / 4); ++id) {
    for (const float value : {kTuningRanges[id].low, kTuningRanges[id].high}) {
      Tuning tuning;
      set_tuning_value(tuning, id, value);
      expect_total(tuning, {.vx_m_s = 0.4F, .vy_m_s = -0.3F, .wz_rad_s = 2.0F}, id);
    }
  }
}

TEST(Gait, CornersOfAllTuningRangesGiveFinitePlans) {
  test::Random random(1);
  for (int round = 0; round < 30; ++round) {
    Tuning tuning;
    for (int id = 0; id < kTuningCount; ++id) {
      const Range& range = kTuningRanges[id];
      set_tuning_value(tuning, id, random.bits() % 2 == 0 ? range.low : range.high);
    }
    expect_total(tuning,
                 {random.between(-4, 4), random.between(-4, 4), random.between(-9, 9),
                  random.between(-0.5F, 0.5F)},
                 1000 + round);
  }
}

}  // namespace
}  // namespace verp::gait
