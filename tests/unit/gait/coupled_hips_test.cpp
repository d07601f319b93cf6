#include "common/gait/coupled_hips.hpp"

#include <gtest/gtest.h>

#include "common/model/coupling.hpp"
#include "tests/unit/gait/walker.hpp"
#include "tests/unit/support/coupled_robot.hpp"

namespace verp::gait {
namespace {

using namespace verp::test;

// As the legs want them, and how well one motor serves both.
struct Yaws {
  float most_rad = 0;  ///< of the driving joint
  float most_off_rad = 0;
  float most_body_turn_rad = 0;
};

Yaws walk(const Params& params, const VelocityIn& wanted, bool turned_to_hips) {
  test::Walker walker(params);
  walker.set_off(wanted);
  Yaws yaws;
  float previous_rad[kFeet][kLegJoints];
  for (int side = 0; side < kFeet; ++side) {
    for (int k = 0; k < kLegJoints; ++k) {
      previous_rad[side][k] = params.joint[params.leg[side].joint[k]].stand_rad;
    }
  }
  for (int tick = 0; tick < 600; ++tick) {
    walker.tick();
    Posture posture = walker.out.posture;
    const Mat3 planned = posture.body.rotation;
    if (turned_to_hips) turn_to_hips(params, previous_rad, posture);
    for (int side = 0; side < kFeet; ++side) {
      const auto leg = kinematics::solve_leg(params, params.leg[side], sole_in_body(posture, side),
                                             previous_rad[side]);
      for (int k = 0; k < kLegJoints; ++k) previous_rad[side][k] = leg.angle_rad[k];
    }
    const float driver_rad = previous_rad[kLeft][0];
    const float off_rad =
        previous_rad[kRight][0] -
        model::followed(params.joint[kLeftLeg], params.joint[kFollower], driver_rad);
    yaws.most_rad = math::max(yaws.most_rad, math::abs(driver_rad));
    yaws.most_off_rad = math::max(yaws.most_off_rad, math::abs(off_rad));
    const Mat3 between = posture.body.rotation * planned.transpose();
    yaws.most_body_turn_rad =
        math::max(yaws.most_body_turn_rad, math::norm(math::rotation_vector(between)));
  }
  return yaws;
}

// One motor serves both yaws to 0.2 mrad; the trunk turns by less than a degree.
TEST(CoupledHips, BodyTurnsUntilOneMotorFitsBothLegs) {
  for (const Params& robot : {kRobot, make_offset_robot()}) {
    const Params params = with_coupled_hips(robot, -1.0F);
    ASSERT_EQ(coupled_hip(params), kRight);
    for (const float wz_rad_s : {0.0F, 0.4F}) {
      const VelocityIn wanted{.vx_m_s = 0.1F, .wz_rad_s = wz_rad_s};
      const Yaws free = walk(params, wanted, false), held = walk(params, wanted, true);
      EXPECT_LT(held.most_off_rad, 2e-4F) << wz_rad_s;
      EXPECT_LT(held.most_body_turn_rad, 0.0175F) << wz_rad_s;
      EXPECT_GT(free.most_off_rad, 5.0F * held.most_off_rad) << "else there is nothing to do";
      if (wz_rad_s > 0.0F) {
        EXPECT_GT(held.most_rad, 0.03F) << "the hips turn the robot";
      }
    }
  }
}

TEST(CoupledHips, AnyRatioThatTurnsTheFeetOppositeWaysWalks) {
  for (const float ratio : {-0.5F, -2.0F}) {
    const Params params = with_coupled_hips(kRobot, ratio);
    const Yaws held = walk(params, {.vx_m_s = 0.1F, .wz_rad_s = 0.3F}, true);
    EXPECT_LT(held.most_off_rad, 2e-3F) << ratio;
  }
}

TEST(CoupledHips, RobotsWithAServoForEachAreLeftAlone) {
  EXPECT_EQ(coupled_hip(kRobot), kBoth);
  const Yaws plain = walk(kRobot, {.vx_m_s = 0.1F, .wz_rad_s = 0.4F}, true);
  EXPECT_EQ(plain.most_body_turn_rad, 0.0F);
}

}  // namespace
}  // namespace verp::gait
