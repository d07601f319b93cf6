#include <gtest/gtest.h>

#include "tests/unit/gait/soles.hpp"

namespace verp::gait {
namespace {

using test::any_order;
using test::apart_m;
using test::corners_of;
using test::kRobot;
using test::kSteps;
using test::least_apart_m;
using test::Walk;

constexpr float kLeastApart_m = 0.001F;

TEST(Soles, NeverOverlapWhereTheyLand) {
  test::Random random(7);
  for (const float half_stance_m : {0.0345F, 0.0356F, 0.0455F}) {
    Walk walk;
    walk.tuning.half_stance_m = half_stance_m;
    for (int turn = 0; turn < 400; ++turn) {
      VelocityIn wanted = any_order(random);
      if (turn % 3 == 0) wanted.vx_m_s = wanted.vy_m_s = 0;
      for (int i = random.below(12); i >= 0; --i) {
        const Step& step = walk.take(wanted);
        ASSERT_GT(apart_m(corners_of(kRobot.leg[kLeft], step.after(kLeft)),
                          corners_of(kRobot.leg[kRight], step.after(kRight))),
                  kLeastApart_m)
            << "turn " << turn;
      }
    }
  }
}

TEST(Soles, PassBesideEachOtherWhereABodyGoesOrTurns) {
  test::Random random(7);
  for (const float half_stance_m : {0.0345F, 0.0356F, 0.0455F}) {
    for (const bool turns : {false, true}) {
      Walk walk;
      walk.tuning.half_stance_m = half_stance_m;
      for (int turn = 0; turn < 200; ++turn) {
        VelocityIn wanted = any_order(random);
        (turns ? wanted.vx_m_s : wanted.wz_rad_s) = 0;
        (turns ? wanted.vy_m_s : wanted.heading_error_rad) = 0;
        for (int i = random.below(12); i >= 0; --i) {
          ASSERT_GT(least_apart_m(kRobot, walk.take(wanted)), kLeastApart_m) << "turn " << turn;
        }
      }
    }
  }
}

// A straight way would cross the other sole by up to 5 mm.
TEST(Soles, PassBesideEachOtherInCurves) {
  for (const float vx : {-0.3F, -0.05F, 0.05F, 0.1F, 0.17F, 0.25F, 0.4F}) {
    for (const float vy : {0.0F, -0.1F, 0.15F}) {
      for (const float wz : {-1.5F, -1.0F, -0.5F, -0.2F, 0.2F, 0.5F, 1.0F, 1.5F}) {
        Walk walk;
        for (int i = 0; i < kSteps; ++i) {
          ASSERT_GT(least_apart_m(kRobot, walk.take({.vx_m_s = vx, .vy_m_s = vy, .wz_rad_s = wz})),
                    kLeastApart_m)
              << vx << ", " << vy << ", " << wz;
        }
      }
    }
  }
}

// 26 mm overlap if the plan ignores the way.
TEST(Soles, PassBesideEachOtherHoweverOrdersJump) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    GaitTuning tuning;
    tuning.half_stance_m = seed % 2 == 0 ? tuning.half_stance_m : 0.0345F;
    tuning.cycle_s = seed % 3 == 0 ? 0.6F : tuning.cycle_s;
    EXPECT_GT(test::least_apart_of_jumps_m(kRobot, tuning, seed, 100), kLeastApart_m) << seed;
  }
}

// Without the rule soles overlap by 29 mm at 1.55 rad/s.
TEST(Soles, TurningFeetLandFurtherOutAndTurnLessWhereThatIsNotEnough) {
  float turned_rad = 0;
  for (const float wz : {0.05F, 0.1F, 0.3F, 0.6F, 1.0F, 1.55F, 3.0F}) {
    for (const float sign : {1.0F, -1.0F}) {
      Walk walk;
      walk.tuning.max_turn_rad = 0.6F;
      walk.tuning.half_stance_m += 0.001F;
      for (int i = 0; i < kSteps; ++i) {
        ASSERT_GT(least_apart_m(kRobot, walk.take({.wz_rad_s = sign * wz})), kLeastApart_m) << wz;
      }
      const float begin_rad = walk.state.body.yaw_rad;
      walk.take({.wz_rad_s = sign * wz});
      walk.take({.wz_rad_s = sign * wz});
      const float cycle_rad = sign * (walk.state.body.yaw_rad - begin_rad);
      EXPECT_GE(cycle_rad, 0.95F * turned_rad) << "who asks more gets no less, " << wz;
      if (wz <= 1.55F) {
        EXPECT_NEAR(cycle_rad, wz * walk.tuning.cycle_s, 1e-4F) << wz;
      }
      EXPECT_EQ((walk.state.notes & kStepWidened) != 0, wz > 0.05F) << wz;
      EXPECT_EQ((walk.state.notes & kTurnShortened) != 0, wz > 1.6F) << wz;
      if (sign < 0) turned_rad = cycle_rad;
    }
  }
}

TEST(Soles, AStanceInWhichTheSolesOverlapIsRefused) {
  for (const float half_stance_m : {0.02F, 0.0329F, 0.0335F, 0.05F}) {
    Walk walk;
    walk.tuning.half_stance_m = half_stance_m;
    for (int i = 0; i < 4; ++i) walk.take({.vx_m_s = 0.1F});
    const bool apart =
        2 * half_stance_m > kRobot.leg[kLeft].sole_right_m + kRobot.leg[kRight].sole_left_m;
    EXPECT_EQ((walk.state.notes & kPlanRefused) == 0, apart) << half_stance_m;
  }
}

TEST(Soles, StraightAndSidewaysWalksAreNotWidened) {
  for (const VelocityIn& wanted : {VelocityIn{.vx_m_s = 0.3F}, VelocityIn{.vx_m_s = -0.2F},
                                   VelocityIn{.vx_m_s = 0.1F, .vy_m_s = 0.08F}}) {
    Walk walk;
    for (int i = 0; i < kSteps; ++i) {
      EXPECT_GT(least_apart_m(kRobot, walk.take(wanted)), kLeastApart_m);
      EXPECT_TRUE(walk.last.bend_m.x == 0.0F && walk.last.bend_m.y == 0.0F) << "a straight way";
    }
    EXPECT_EQ(walk.state.notes & (kStepWidened | kTurnShortened), 0u);
  }
}

}  // namespace
}  // namespace verp::gait
