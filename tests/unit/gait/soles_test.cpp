#include <gtest/gtest.h>

#include "common/gait/footsteps.hpp"
#include "common/gait/swing.hpp"
#include "tests/unit/gait/steps.hpp"

/// Where a robot sets its feet, and on the way there: soles keep apart, as seen from above.
namespace verp::gait {
namespace {

using test::kRobot;
using test::kSteps;
using test::Walk;

struct Corners {
  Xy at[4];
};

Corners corners_of(int side, const Foothold& foot) {
  const LegParams& leg = kRobot.leg[side];
  const Xy in_sole[4] = {{leg.sole_front_m, leg.sole_left_m},
                         {-leg.sole_back_m, leg.sole_left_m},
                         {-leg.sole_back_m, -leg.sole_right_m},
                         {leg.sole_front_m, -leg.sole_right_m}};
  Corners corners;
  for (int i = 0; i < 4; ++i) corners.at[i] = foot.at_m + turned(in_sole[i], foot.yaw_rad);
  return corners;
}

// Two convex shapes are apart if a side of one of them has the other wholly beyond it: by the most
// that any side tells.
float apart_m(const Corners& a, const Corners& b) {
  float most_m = -1;
  for (int shape = 0; shape < 2; ++shape) {
    const Corners &own = shape == 0 ? a : b, &other = shape == 0 ? b : a;
    for (int i = 0; i < 4; ++i) {
      const Xy side = own.at[(i + 1) % 4] - own.at[i];
      // Corners go round to the left.
      const Xy out = (1.0F / math::hypot(side.x, side.y)) * Xy{side.y, -side.x};
      float least_m = 1;
      for (const Xy& corner : other.at) least_m = math::min(least_m, dot(corner - own.at[i], out));
      most_m = math::max(most_m, least_m);
    }
  }
  return most_m;
}

// The swing foot's whole way, as seen from above: it is but a few millimetres up.
float least_apart_m(const Step& step) {
  float least_m = 1;
  for (int i = 0; i <= 20; ++i) {
    const float time_s = 0.05F * static_cast<float>(i) * step.duration_s();
    least_m = math::min(least_m, apart_m(corners_of(kLeft, foot_at(step, kLeft, time_s).on),
                                         corners_of(kRight, foot_at(step, kRight, time_s).on)));
  }
  return least_m;
}

constexpr float kLeastApart_m = 0.001F;

VelocityIn any_order(test::Random& random) {
  return {.vx_m_s = random.between(-0.8F, 0.8F),
          .vy_m_s = random.between(-0.5F, 0.5F),
          .wz_rad_s = random.between(-4, 4),
          .heading_error_rad = random.between(-1, 1)};
}

// Whatever an operator asks, and whenever he changes his mind.
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
        ASSERT_GT(
            apart_m(corners_of(kLeft, step.after(kLeft)), corners_of(kRight, step.after(kRight))),
            kLeastApart_m)
            << "turn " << turn;
      }
    }
  }
}

// Whoever goes any way, or turns on the spot, however his orders jump.
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
          ASSERT_GT(least_apart_m(walk.take(wanted)), kLeastApart_m) << "turn " << turn;
        }
      }
    }
  }
}

// Who does both keeps clear as fast as the paper's walk is. Faster (0.25 m/s with 0.6 rad/s), or
// where orders jump, a swinging sole passes over the other's edge, a centimetre up: a plan looks at
// landings.
TEST(Soles, PassBesideEachOtherInCurves) {
  for (const float vx : {-0.05F, 0.05F, 0.1F, 0.17F}) {
    for (const float wz : {-1.0F, -0.5F, -0.2F, 0.2F, 0.5F, 1.0F}) {
      Walk walk;
      for (int i = 0; i < kSteps; ++i) {
        ASSERT_GT(least_apart_m(walk.take({.vx_m_s = vx, .wz_rad_s = wz})), kLeastApart_m)
            << vx << ", " << wz;
      }
    }
  }
}

// Each of them held: what was 1.8 mm of overlap at 0.3 rad/s and 29 mm at 1.55.
TEST(Soles, TurningFeetLandFurtherOutAndTurnLessWhereThatIsNotEnough) {
  float turned_rad = 0;
  for (const float wz : {0.05F, 0.1F, 0.3F, 0.6F, 1.0F, 1.55F, 3.0F}) {
    for (const float sign : {1.0F, -1.0F}) {
      Walk walk;
      for (int i = 0; i < kSteps; ++i) {
        ASSERT_GT(least_apart_m(walk.take({.wz_rad_s = sign * wz})), kLeastApart_m) << wz;
      }
      const float begin_rad = walk.state.body.yaw_rad;
      walk.take({.wz_rad_s = sign * wz});
      walk.take({.wz_rad_s = sign * wz});
      const float cycle_rad = sign * (walk.state.body.yaw_rad - begin_rad);
      EXPECT_GE(cycle_rad, 0.95F * turned_rad) << "who asks more gets no less, " << wz;
      if (wz <= 0.6F) {
        EXPECT_NEAR(cycle_rad, wz * walk.tuning.cycle_s, 1e-4F) << wz;
      }
      EXPECT_EQ((walk.state.notes & kStepWidened) != 0, wz > 0.05F) << wz;
      EXPECT_EQ((walk.state.notes & kTurnShortened) != 0, wz > 1.2F) << wz;
      if (sign < 0) turned_rad = cycle_rad;
    }
  }
}

// No landing helps a robot whose soles overlap as it stands.
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
    for (int i = 0; i < kSteps; ++i) EXPECT_GT(least_apart_m(walk.take(wanted)), kLeastApart_m);
    EXPECT_EQ(walk.state.notes & (kStepWidened | kTurnShortened), 0u);
  }
}

}  // namespace
}  // namespace verp::gait
