#include "common/model/coupling.hpp"

#include <gtest/gtest.h>

#include "common/kinematics/forward.hpp"
#include "common/model/image.hpp"
#include "tests/unit/support/coupled_robot.hpp"

namespace verp::model {
namespace {

using namespace verp::test;

TEST(Coupling, WhatTheServoTellsIsTheFollowersToo) {
  for (const float ratio : {-1.0F, 2.0F, 0.5F}) {
    Params params = with_coupled_hips(kRobot, ratio);
    params.joint[kFollower].zero_count += 0.1F * params.joint[kFollower].counts_per_rad;
    Inputs inputs;
    inputs.fresh = 1u << kLeftLeg;
    inputs.position_count[kLeftLeg] = 2248;
    share_counts(params, inputs);
    EXPECT_EQ(inputs.fresh, 1u << kLeftLeg | 1u << kFollower);
    const float driver_rad = angle_of(params.joint[kLeftLeg], inputs.position_count[kLeftLeg]);
    const float own_rad = angle_of(params.joint[kFollower], inputs.position_count[kFollower]);
    EXPECT_NEAR(own_rad, ratio * driver_rad - 0.1F, 1e-5F) << ratio;
    inputs.fresh = 0;
    share_counts(params, inputs);
    EXPECT_EQ(inputs.fresh, 0u);
  }
}

TEST(Coupling, DriversTakeTheirFollowersAlongAndBearTheirCorrections) {
  const Params params = with_coupled_hips(kRobot, 2.0F);
  float plain_rad[kMaxJoints] = {}, angle_rad[kMaxJoints] = {};
  plain_rad[kLeftLeg] = angle_rad[kLeftLeg] = 0.2F;
  plain_rad[kFollower] = 0.4F;
  angle_rad[kFollower] = 0.41F;  // sags by 0.01 rad
  share_corrections(params, plain_rad, angle_rad);
  lead(params, angle_rad);
  EXPECT_NEAR(angle_rad[kLeftLeg], 0.205F, 1e-6F);
  EXPECT_NEAR(angle_rad[kFollower], 0.41F, 1e-6F);
  for (int j = 0; j < kFollower; ++j) {
    if (j != kLeftLeg) {
      EXPECT_EQ(angle_rad[j], 0.0F) << j;
    }
  }
}

TEST(Coupling, ListOrderDoesNotMoveTheRobot) {
  const Params params = with_coupled_hips(kRobot, -1.0F);
  Random random(1);
  float angle_rad[kMaxJoints] = {}, coupled_rad[kMaxJoints] = {};
  random_angles(kRobot, 0, random, angle_rad);
  for (int j = 0; j < kJointCount; ++j) {
    coupled_rad[j == kRightLeg ? kFollower : j > kRightLeg ? j - 1 : j] = angle_rad[j];
  }
  Pose plain[kMaxNodes], coupled[kMaxNodes];
  kinematics::all_poses(kRobot, Pose{}, angle_rad, plain);
  kinematics::all_poses(params, Pose{}, coupled_rad, coupled);
  const int foot = kJointCount, same_foot = kJointCount - 1;
  EXPECT_EQ(plain[foot].position_m, coupled[same_foot].position_m);
  EXPECT_EQ(plain[foot].rotation, coupled[same_foot].rotation);
  EXPECT_EQ(plain[kRightLeg + 1].rotation, coupled[kFollower + 1].rotation);
}

TEST(Coupling, ImagesWhoseFollowersFollowNobodyOrHangInACircleAreRefused) {
  Params params = with_coupled_hips(kRobot, -1.0F);
  EXPECT_TRUE(is_well_formed(params));
  Params lost = params;
  lost.joint[kFollower].servo_id = 99;
  EXPECT_FALSE(is_well_formed(lost));
  Params circle = params;
  circle.joint[kFollower].parent = kRightLeg + 1;  // the hip roll, the follower's child
  EXPECT_FALSE(is_well_formed(circle));
  Params many = params;
  many.followers = kJointCount + 1;
  EXPECT_FALSE(is_well_formed(many));
}

}  // namespace
}  // namespace verp::model
