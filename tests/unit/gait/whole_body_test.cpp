#include "common/gait/whole_body.hpp"

#include <gtest/gtest.h>

#include "common/model/tree.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::gait {
namespace {

using test::kRobot;

Posture standing(const GaitTuning& tuning) {
  FootPose left, right;
  left.on.at_m = {0, tuning.half_stance_m};
  right.on.at_m = {0, -tuning.half_stance_m};
  return posture_of(kRobot, tuning, {}, left, right);
}

TEST(WholeBody, WeighsWhatKinematicsWeighs) {
  test::Random random(1);
  float angle_rad[kMaxJoints];
  test::random_angles(kRobot, 0.3F, random, angle_rad);
  const Lump lump = lump_of(kRobot, angle_rad);
  const Posture posture = standing({});
  float leg_rad[kFeet * kLegJoints] = {};
  const Masses masses = weigh(kRobot, lump, posture, leg_rad);
  for (int k = 0; k < kFeet * kLegJoints; ++k) angle_rad[test::kLeftLeg + k] = leg_rad[k];
  const Vec3 all = kinematics::center_of_mass(kRobot, posture.body, angle_rad);
  EXPECT_LT(test::distance(masses.com_m, all), 1e-6F);
  float mass_kg = 0;
  for (int point = 0; point < kPoints; ++point) mass_kg += point_mass_kg(kRobot, lump, point);
  EXPECT_NEAR(mass_kg, model::total_mass(kRobot), 1e-5F);
}

TEST(WholeBody, LumpHasWhatALegCarriesBeyondItsOwnJoints) {
  Params robot = kRobot;
  const int toe = robot.leg[1].joint[kLegJoints - 1];
  robot.leg[1].joint[kLegJoints - 1] = kNoJoint;
  test::Random random(2);
  float angle_rad[kMaxJoints];
  test::random_angles(robot, 0.3F, random, angle_rad);
  const Lump without = lump_of(kRobot, angle_rad), with = lump_of(robot, angle_rad);
  const JointParams& joint = robot.joint[toe];
  const Vec3 com_m = math::apply(kinematics::node_pose(robot, Pose{}, angle_rad, toe + 1),
                                 math::to_vec(joint.com_link_m));
  EXPECT_NEAR(with.mass_kg, without.mass_kg + joint.mass_kg, 1e-6F);
  const Vec3 moment_kg_m =
      without.mass_kg * math::to_vec(without.com_body_m) + joint.mass_kg * com_m;
  EXPECT_LT(test::distance(with.mass_kg * math::to_vec(with.com_body_m), moment_kg_m), 1e-6F);
}

TEST(WholeBody, HipsStandAtTheTunedHeightAtAnyPitch) {
  GaitTuning tuning;
  for (const float pitch_rad : {-0.3F, 0.0F, 0.2F}) {
    tuning.trunk_pitch_rad = pitch_rad;
    const Posture posture = standing(tuning);
    const Vec3 hip = math::apply(posture.body, math::to_vec(kRobot.leg[0].hip_body_m));
    EXPECT_NEAR(hip.z(), tuning.hip_height_m + 0.0335F, 1e-6F);
    const Pose sole = posture.body * sole_in_body(posture, kLeft);
    EXPECT_NEAR(sole.position_m.z(), 0.0F, 1e-6F);
    EXPECT_NEAR(sole.position_m.y(), tuning.half_stance_m, 1e-6F);
    EXPECT_LT(test::turn_between(sole.rotation, Mat3::Identity()), 1e-3F);
  }
}

TEST(WholeBody, ComShareIsHowFarTheComFollowsTheBody) {
  const GaitTuning tuning;
  const float arms_rad[kMaxJoints] = {};
  const Lump lump = lump_of(kRobot, arms_rad);
  Posture posture = standing(tuning);
  float leg_rad[kFeet * kLegJoints] = {};
  const Masses before = weigh(kRobot, lump, posture, leg_rad);
  const float share = com_share(kRobot, lump, posture, before);
  constexpr float kMove_m = 0.005F;
  for (const int axis : {0, 1}) {
    Posture moved = posture;
    moved.body.position_m(axis) += kMove_m;
    const Masses after = weigh(kRobot, lump, moved, leg_rad);
    EXPECT_NEAR((after.com_m(axis) - before.com_m(axis)) / kMove_m, share, 0.03F);
  }
}

TEST(WholeBody, HyperextendedZeroIsNoPlaceToStartFrom) {
  static const Params robot = test::make_hyperextended_robot();
  const Lump lump{2, {}};
  float leg_rad[kFeet * kLegJoints] = {};
  EXPECT_NE(weigh(robot, lump, standing({}), leg_rad).leg_flags, 0);
  EXPECT_EQ(leg_rad[3], robot.joint[test::kLeftLeg + 3].stand_rad) << "its own way out";
  EXPECT_EQ(weigh(robot, lump, standing({}), leg_rad).leg_flags, 0);
  float from_stand_rad[kFeet * kLegJoints] = {};
  stand_legs(robot, from_stand_rad);
  EXPECT_EQ(weigh(robot, lump, standing({}), from_stand_rad).leg_flags, 0);
  EXPECT_GT(from_stand_rad[3], 1.0F);
}

TEST(Swing, FootRestsLiftsAndLandsWhereItShould) {
  Step step;
  step.key_us = 15000;
  step.key_points = 15;
  step.swing = kRight;
  step.double_support_s = 0.05F;
  step.lift_m = 0.01F;
  step.foot[kLeft] = {{0, 0.04F}, 0};
  step.foot[kRight] = {{-0.04F, -0.04F}, 0};
  step.landing = {{0.04F, -0.04F}, 0.2F};
  for (const float time_s : {-1.0F, 0.0F, 0.05F}) {
    EXPECT_EQ(foot_at(step, kRight, time_s).on.at_m.x, -0.04F);
    EXPECT_EQ(foot_at(step, kRight, time_s).height_m, 0.0F);
  }
  const FootPose apex = foot_at(step, kRight, 0.05F + 0.5F * 0.175F);
  EXPECT_NEAR(apex.height_m, 0.01F, 1e-6F);
  EXPECT_NEAR(apex.on.at_m.x, 0.0F, 1e-6F);
  for (const float time_s : {0.225F, 1.0F}) {
    EXPECT_NEAR(foot_at(step, kRight, time_s).on.at_m.x, 0.04F, 1e-6F);
    EXPECT_NEAR(foot_at(step, kRight, time_s).on.yaw_rad, 0.2F, 1e-6F);
    EXPECT_NEAR(foot_at(step, kRight, time_s).height_m, 0.0F, 1e-6F);
  }
  EXPECT_EQ(foot_at(step, kLeft, 0.1F).on.at_m.x, 0.0F);
  for (float time_s = 0; time_s < 0.24F; time_s += 0.005F) {
    EXPECT_GE(foot_at(step, kRight, time_s).height_m, 0.0F);
  }
}

TEST(Swing, WayBendsAroundTheOtherFoot) {
  Step step;
  step.key_us = 15000;
  step.key_points = 15;
  step.swing = kLeft;
  step.foot[kLeft] = {{-0.04F, 0.04F}, 0};
  step.landing = {{0.04F, 0.04F}, 0};
  step.bend_m = {0, 0.01F};
  for (const float time_s : {0.0F, step.duration_s()}) {
    EXPECT_EQ(foot_at(step, kLeft, time_s).on.at_m.y, 0.04F);
  }
  EXPECT_NEAR(foot_at(step, kLeft, 0.5F * step.duration_s()).on.at_m.y, 0.05F, 1e-6F);
  EXPECT_GT(foot_at(step, kLeft, 0.25F * step.duration_s()).on.at_m.y, 0.045F);
}

// The body sags over one foot.
TEST(Swing, SoleTouchesDownHighAndSettles) {
  Step step;
  step.key_us = 15000;
  step.key_points = 15;
  step.swing = kRight;
  step.double_support_s = 0.02F;
  step.lift_m = 0.01F;
  step.touchdown_m = 0.003F;
  EXPECT_NEAR(foot_at(step, kRight, step.duration_s()).height_m, 0.003F, 1e-6F);
  EXPECT_GT(foot_at(step, kRight, 0.12F).height_m, 0.01F);

  Step next = step;
  next.swing = kLeft;
  next.landed = kRight;
  next.settle_m = step.touchdown_m;
  EXPECT_NEAR(foot_at(next, kRight, 0.0F).height_m, 0.003F, 1e-6F) << "no jump between two steps";
  EXPECT_NEAR(foot_at(next, kRight, 0.015F).height_m, 0.0015F, 1e-6F);
  EXPECT_EQ(foot_at(next, kRight, 2.0F * next.key_s()).height_m, 0.0F);
  EXPECT_EQ(foot_at(next, kLeft, 0.0F).height_m, 0.0F) << "the other foot stood";
}

TEST(Swing, AccelerationIsTheSecondDerivative) {
  Step step;
  step.key_us = 15000;
  step.key_points = 15;
  step.swing = kLeft;
  step.lift_m = 0.02F;
  step.touchdown_m = 0.004F;
  step.foot[kLeft] = {{-0.04F, 0.04F}, 0};
  step.landing = {{0.04F, 0.05F}, 0};
  step.bend_m = {-0.001F, 0.008F};
  constexpr float kStep_s = 0.004F;
  for (float time_s = 0.02F; time_s < 0.2F; time_s += 0.02F) {
    const FootPose before = foot_at(step, kLeft, time_s - kStep_s);
    const FootPose here = foot_at(step, kLeft, time_s);
    const FootPose after = foot_at(step, kLeft, time_s + kStep_s);
    const auto second = [&](float a, float b, float c) {
      return ((a - b) + (c - b)) / (kStep_s * kStep_s);
    };
    EXPECT_NEAR(here.accel_m_s2.x, second(before.on.at_m.x, here.on.at_m.x, after.on.at_m.x), 0.1F);
    EXPECT_NEAR(here.accel_m_s2.y, second(before.on.at_m.y, here.on.at_m.y, after.on.at_m.y), 0.1F);
    EXPECT_NEAR(here.accel_m_s2.z, second(before.height_m, here.height_m, after.height_m), 0.1F);
  }
}

}  // namespace
}  // namespace verp::gait
