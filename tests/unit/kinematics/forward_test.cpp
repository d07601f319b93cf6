#include "common/kinematics/forward.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::kinematics {
namespace {

using test::kRobot;
using test::Random;

// No result may depend on the body's pose.
Pose some_body() {
  return {math::rotation_rpy(0.1F, -0.2F, 0.7F), Vec3(0.3F, -0.2F, 0.25F)};
}

Params all_axes_robot() {
  Params params = kRobot;
  constexpr AxisKind kKinds[] = {AxisKind::kMinusX,  AxisKind::kMinusY, AxisKind::kMinusZ,
                                 AxisKind::kGeneral, AxisKind::kX,      AxisKind::kZ};
  for (int k = 0; k < kLegJoints; ++k) params.joint[test::kLeftLeg + k].axis_kind = kKinds[k];
  params.joint[test::kLeftLeg].axis = {-1, 0, 0};
  params.joint[test::kLeftLeg + 1].axis = {0, -1, 0};
  params.joint[test::kLeftLeg + 2].axis = {0, 0, -1};
  params.joint[test::kLeftLeg + 3].axis = {0.48F, 0.6F, 0.64F};
  params.joint[test::kLeftLeg + 4].axis = {1, 0, 0};
  params.joint[test::kLeftLeg + 5].axis = {0, 0, 1};
  return params;
}

// p = p0 + R0 p1, R = R0 R1, by Rodrigues' formula alone.
Pose by_chain_rule(const Params& params, const Pose& body, const float* angle_rad, int node) {
  if (node == 0) return body;
  const JointParams& joint = params.joint[node - 1];
  const Pose step{math::rotation(math::to_vec(joint.axis), angle_rad[node - 1]),
                  math::to_vec(joint.origin_parent_m)};
  return by_chain_rule(params, body, angle_rad, joint.parent) * step;
}

TEST(Forward, OnePassRecursionAndChainRuleAgree) {
  const Params params = all_axes_robot();
  const Pose body = some_body();
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    float angle_rad[kMaxJoints];
    test::random_angles(params, 0, random, angle_rad);
    Pose all[kMaxNodes];
    all_poses(params, body, angle_rad, all);
    for (int node = 0; node <= params.joint_count; ++node) {
      const Pose one = node_pose(params, body, angle_rad, node);
      EXPECT_TRUE(one.position_m == all[node].position_m && one.rotation == all[node].rotation);
      const Pose ruled = by_chain_rule(params, body, angle_rad, node);
      EXPECT_LT(test::distance(one.position_m, ruled.position_m), 2e-6F) << "node " << node;
      EXPECT_LT((one.rotation - ruled.rotation).cwiseAbs().maxCoeff(), 3e-6F) << "node " << node;
    }
  }
}

TEST(Forward, JointTransformIsTheLinkSeenFromItsParent) {
  const Params params = all_axes_robot();
  Random random(6);
  float angle_rad[kMaxJoints];
  test::random_angles(params, 0, random, angle_rad);
  Pose node[kMaxNodes];
  all_poses(params, some_body(), angle_rad, node);
  for (int j = 0; j < params.joint_count; ++j) {
    const Pose product =
        node[params.joint[j].parent] * joint_transform(params.joint[j], angle_rad[j]);
    EXPECT_LT(test::distance(node[j + 1].position_m, product.position_m), 1e-6F) << "joint " << j;
    EXPECT_LT(test::turn_between(node[j + 1].rotation, product.rotation), 1e-3F) << "joint " << j;
  }
}

TEST(Forward, ZeroPoseHasLinksParallelToTheBody) {
  const float zero[kMaxJoints] = {};
  Pose node[kMaxNodes];
  all_poses(kRobot, Pose{}, zero, node);
  for (int n = 0; n <= kRobot.joint_count; ++n) EXPECT_TRUE(node[n].rotation == Mat3::Identity());
  const LegChain left = leg_chain(kRobot, kRobot.leg[0], Pose{}, zero);
  const Pose sole = sole_pose(kRobot.leg[0], left);
  EXPECT_NEAR(sole.position_m.y(), 0.037F, 1e-6F);
  EXPECT_NEAR(sole.position_m.z(), -0.085F - 2 * 0.093F - 0.0335F, 1e-6F);
}

TEST(Forward, LegChainIsTheLegsPartOfAllPoses) {
  Random random(2);
  float angle_rad[kMaxJoints];
  test::random_angles(kRobot, 0, random, angle_rad);
  Pose node[kMaxNodes];
  all_poses(kRobot, some_body(), angle_rad, node);
  const LegChain right = leg_chain(kRobot, kRobot.leg[1], some_body(), angle_rad + test::kRightLeg);
  for (int k = 0; k < kLegJoints; ++k) {
    EXPECT_TRUE(right.link[k].position_m == node[test::kRightLeg + k + 1].position_m);
    EXPECT_TRUE(right.link[k].rotation == node[test::kRightLeg + k + 1].rotation);
  }
}

TEST(CenterOfMass, OfTheMirroredPoseIsMirrored) {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    float angle_rad[kMaxJoints], mirror_rad[kMaxJoints];
    test::random_angles(kRobot, 0, random, angle_rad);
    test::mirror_angles(angle_rad, mirror_rad);
    const Vec3 here = center_of_mass(kRobot, Pose{}, angle_rad);
    const Vec3 there = center_of_mass(kRobot, Pose{}, mirror_rad);
    EXPECT_LT(test::distance(test::mirrored(here), there), 1e-6F);
  }
}

TEST(CenterOfMass, MovesWithTheBody) {
  Random random(4);
  float angle_rad[kMaxJoints];
  test::random_angles(kRobot, 0, random, angle_rad);
  const Vec3 in_body = center_of_mass(kRobot, Pose{}, angle_rad);
  const Vec3 outside = center_of_mass(kRobot, some_body(), angle_rad);
  EXPECT_LT(test::distance(outside, math::apply(some_body(), in_body)), 1e-6F);
}

TEST(CenterOfMass, OfARobotWithoutMassIsItsBody) {
  Params params = kRobot;
  params.body_mass_kg = 0;
  for (JointParams& joint : params.joint) joint.mass_kg = 0;
  const float zero[kMaxJoints] = {};
  EXPECT_TRUE(center_of_mass(params, some_body(), zero) == some_body().position_m);
}

// Central differences in float32: 1e-7 m / 2e-2 rad.
TEST(Jacobian, IsTheDerivativeOfTheSolesPose) {
  const Params params = all_axes_robot();
  constexpr float kStep_rad = 1e-2F;
  Random random(5);
  for (int round = 0; round < 8; ++round) {
    float angle_rad[kMaxJoints];
    test::random_angles(params, 0.1F, random, angle_rad);
    for (int side = 0; side < kFeet; ++side) {
      const LegParams& leg = params.leg[side];
      float* leg_rad = angle_rad + leg.joint[0];
      const LegChain here = leg_chain(params, leg, some_body(), leg_rad);
      const Mat6 jacobian = leg_jacobian(params, leg, here, sole_pose(leg, here).position_m);
      for (int k = 0; k < kLegJoints; ++k) {
        const float middle_rad = leg_rad[k];
        leg_rad[k] = middle_rad + kStep_rad;
        const Pose after = sole_pose(leg, leg_chain(params, leg, some_body(), leg_rad));
        leg_rad[k] = middle_rad - kStep_rad;
        const Pose before = sole_pose(leg, leg_chain(params, leg, some_body(), leg_rad));
        leg_rad[k] = middle_rad;
        const Vec3 linear = (after.position_m - before.position_m) / (2 * kStep_rad);
        const Vec3 angular =
            math::rotation_vector(after.rotation * before.rotation.transpose()) / (2 * kStep_rad);
        for (int i = 0; i < 3; ++i) {
          EXPECT_NEAR(jacobian(i, k), linear[i], 1e-4F) << "joint " << k;
          EXPECT_NEAR(jacobian(i + 3, k), angular[i], 1e-3F) << "joint " << k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace verp::kinematics
