#include "common/balance/gravity.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::balance {
namespace {

using test::kRobot;

constexpr float kG = math::kGravityMS2;

// Walking pose, body at the origin.
constexpr float kBent_rad[kLegJoints] = {0, 0.02F, -0.63F, 1.26F, -0.63F, -0.02F};

LegLoad carrying(const LegParams& leg, const kinematics::LegChain& chain, float push_n) {
  const Pose sole = kinematics::sole_pose(leg, chain);
  return {sole.position_m, {0, 0, push_n}, {0, 0, kG}, {0, 0, kG}};
}

struct Sag {
  float leg_rad[kLegJoints];
  float added_rad[kLegJoints];
  kinematics::LegChain before, after;
};

Sag sag_of(const Params& params, const LegParams& leg, const float* pose_rad, float push_n) {
  Sag sag;
  for (int k = 0; k < kLegJoints; ++k) sag.leg_rad[k] = pose_rad[k];
  sag.before = kinematics::leg_chain(params, leg, Pose{}, pose_rad);
  add_sag(params, {}, leg, sag.before, carrying(leg, sag.before, push_n), {}, sag.leg_rad);
  for (int k = 0; k < kLegJoints; ++k) sag.added_rad[k] = sag.leg_rad[k] - pose_rad[k];
  sag.after = kinematics::leg_chain(params, leg, Pose{}, sag.leg_rad);
  return sag;
}

TEST(Gravity, GoalsOfACarryingLegLiftTheBody) {
  for (const LegParams& leg : kRobot.leg) {
    const Sag sag = sag_of(kRobot, leg, kBent_rad, 30);
    EXPECT_LT(sag.added_rad[3], -0.005F) << "knee stretches";
    EXPECT_LT(kinematics::sole_pose(leg, sag.after).position_m.z(),
              kinematics::sole_pose(leg, sag.before).position_m.z() - 1e-3F);
  }
}

// The push does negative work over the displacement.
TEST(Gravity, CorrectionAlwaysWorksAgainstTheLoad) {
  static const Params massless = test::make_massless_legs_robot();
  test::Random random(1);
  for (int round = 0; round < 50; ++round) {
    float angle_rad[kMaxJoints];
    test::random_angles(massless, 0.2F, random, angle_rad);
    const LegParams& leg = massless.leg[round % 2];
    const Sag sag = sag_of(massless, leg, angle_rad + leg.joint[0], 5);
    EXPECT_LT(kinematics::sole_pose(leg, sag.after).position_m.z(),
              kinematics::sole_pose(leg, sag.before).position_m.z());
  }
}

TEST(Gravity, GoalsOfAHangingLegLiftTheFoot) {
  const LegParams& leg = kRobot.leg[0];
  const Sag sag = sag_of(kRobot, leg, kBent_rad, 0);
  EXPECT_GT(kinematics::sole_pose(leg, sag.after).position_m.z(),
            kinematics::sole_pose(leg, sag.before).position_m.z());
}

TEST(Gravity, MirroredLegsSagAlike) {
  float mirror_rad[kLegJoints];
  for (int k = 0; k < kLegJoints; ++k) {
    mirror_rad[k] =
        test::kRows[test::kLeftLeg + k].axis == AxisKind::kY ? kBent_rad[k] : -kBent_rad[k];
  }
  const Sag left = sag_of(kRobot, kRobot.leg[0], kBent_rad, 30);
  const Sag right = sag_of(kRobot, kRobot.leg[1], mirror_rad, 30);
  for (int k = 0; k < kLegJoints; ++k) {
    const float sign = test::kRows[test::kLeftLeg + k].axis == AxisKind::kY ? 1.0F : -1.0F;
    EXPECT_NEAR(left.added_rad[k], sign * right.added_rad[k], 1e-6F) << "joint " << k;
  }
}

TEST(Gravity, StiffServosNeedNoCorrection) {
  Params stiff = kRobot;
  for (JointParams& joint : stiff.joint) joint.compliance_rad_nm = 0;
  const Sag sag = sag_of(stiff, stiff.leg[0], kBent_rad, 30);
  for (int k = 0; k < kLegJoints; ++k) EXPECT_EQ(sag.added_rad[k], 0.0F) << "joint " << k;
}

// A force of 10 N, 50 mm beside the knee's axis.
TEST(Gravity, SagIsTorqueTimesCompliance) {
  static const Params massless = test::make_massless_legs_robot();
  const float straight_rad[kLegJoints] = {};
  const LegParams& leg = massless.leg[0];
  const kinematics::LegChain chain = kinematics::leg_chain(massless, leg, Pose{}, straight_rad);
  LegLoad load = carrying(leg, chain, 10);
  load.ground_m.x() += 0.05F;
  float leg_rad[kLegJoints] = {};
  add_sag(massless, {}, leg, chain, load, {}, leg_rad);
  // The push turns the shank nose up; the servo holds with +0.5 N m.
  EXPECT_NEAR(leg_rad[3], 0.5F * 0.0263F, 1e-5F);
}

TEST(Gravity, FrictionAndInertiaAreFedForward) {
  static const Params massless = test::make_massless_legs_robot();
  Params geared = massless;
  const LegParams& leg = geared.leg[0];
  JointParams& knee = geared.joint[leg.joint[3]];
  knee.friction_n_m = 0.04F;
  knee.load_friction = 0.2F;
  knee.friction_speed_rad_s = 1.5F;
  knee.armature_kg_m2 = 0.01F;
  const float straight_rad[kLegJoints] = {};
  const kinematics::LegChain chain = kinematics::leg_chain(geared, leg, Pose{}, straight_rad);
  LegLoad load = carrying(leg, chain, 10);
  load.ground_m.x() += 0.05F;
  const auto knee_nm = [&](float rate, float accel, float share) {
    LegMotion motion;
    motion.rate_rad_s[3] = rate;
    motion.accel_rad_s2[3] = accel;
    BalanceTuning tuning;
    tuning.friction_share = tuning.inertia_share = share;
    float leg_rad[kLegJoints] = {};
    add_sag(geared, tuning, leg, chain, load, motion, leg_rad);
    return leg_rad[3] / knee.compliance_rad_nm;
  };
  // At the speed where half is left: (0.04 + 2 * 0.2 * 0.5) / 2, less the part whose sign is
  // unsure.
  EXPECT_NEAR(knee_nm(1.5F, 0, 1) - 0.5F, 0.12F * 1.5F / 1.6F, 1e-3F);
  EXPECT_NEAR(knee_nm(-1.5F, 0, 1) - 0.5F, -0.12F * 1.5F / 1.6F, 1e-3F);
  EXPECT_NEAR(knee_nm(0, 20, 1) - 0.5F, 0.2F, 1e-3F);
  EXPECT_NEAR(knee_nm(1.5F, 20, 0), 0.5F, 1e-3F);
}

TEST(Gravity, FollowsThePlanButNotItsLeaps) {
  DriveState state;
  const float period_s = static_cast<float>(kRobot.period_us) * 1e-6F;
  float leg_rad[kLegJoints] = {};
  for (float& angle : leg_rad) angle = 2;
  LegMotion motion = follow(kRobot, 1, leg_rad, state);
  for (int k = 0; k < kLegJoints; ++k) {
    EXPECT_EQ(motion.rate_rad_s[k], 0.0F);
    EXPECT_EQ(motion.accel_rad_s2[k], 0.0F);
  }
  for (int tick = 1; tick <= 3; ++tick) {  // 10 rad/s2 from rest
    for (float& angle : leg_rad) angle += 10 * static_cast<float>(tick) * period_s * period_s;
    motion = follow(kRobot, 1, leg_rad, state);
  }
  EXPECT_NEAR(motion.rate_rad_s[3], 10 * 3 * period_s, 1e-3F);
  EXPECT_NEAR(motion.accel_rad_s2[3], 10, 0.1F);
}

TEST(Gravity, GroundPointIsTheZmpHeldInsideTheSole) {
  const LegParams& leg = kRobot.leg[0];
  gait::FootPose foot;
  foot.on = {{0.1F, 0.04F}, 0};
  foot.height_m = 0.003F;
  EXPECT_LT(test::distance(ground_point(leg, foot, {0.11F, 0.05F}), Vec3(0.11F, 0.05F, 0.003F)),
            1e-6F);
  EXPECT_LT(test::distance(ground_point(leg, foot, {1, -1}), Vec3(0.152F, 0.007F, 0.003F)), 1e-6F);
  foot.on.yaw_rad = math::kHalfPi;
  EXPECT_LT(test::distance(ground_point(leg, foot, {0.1F, 1}), Vec3(0.1F, 0.092F, 0.003F)), 1e-6F);
}

}  // namespace
}  // namespace verp::balance
