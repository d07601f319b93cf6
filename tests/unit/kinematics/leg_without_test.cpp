#include <gtest/gtest.h>

#include "common/kinematics/leg_ik.hpp"
#include "common/model/leg.hpp"
#include "tests/unit/support/test_robot.hpp"

/// Legs without hip yaw, ankle roll or both.
namespace verp::kinematics {
namespace {

using test::Random;

constexpr int kYaw = 0, kRoll = kLegJoints - 1;
constexpr float kOff_m = 1e-4F;
constexpr float kTurned_rad = 1e-3F;

const Params& without(bool yaw, bool roll) {
  static Params params;
  params = test::kRobot;
  for (LegParams& leg : params.leg) {
    leg.solver = LegSolver::kNewton;
    if (yaw) leg.joint[kYaw] = kNoJoint;
    if (roll) leg.joint[kRoll] = kNoJoint;
    if (yaw) params.joint[leg.joint[1]].origin_parent_m = leg.hip_body_m;
    if (yaw) params.joint[leg.joint[1]].parent = 0;
  }
  return params;
}

/// Well inside the limits, and a start nearby.
void random_leg(const Params& params, const LegParams& leg, Random& random, float* leg_rad,
                float* start_rad) {
  for (int k = 0; k < kLegJoints; ++k) {
    const JointParams& joint = model::joint_of(params, leg, k);
    const float middle_rad = 0.5F * (joint.lower_rad + joint.upper_rad);
    const float half_rad = 0.35F * (joint.upper_rad - joint.lower_rad);
    leg_rad[k] = middle_rad + random.between(-half_rad, half_rad);
    start_rad[k] = model::has(leg, k) ? leg_rad[k] + random.between(-0.05F, 0.05F) : 0.0F;
  }
}

Pose pose_of(const Params& params, const LegParams& leg, const float* leg_rad) {
  return sole_pose(leg, leg_chain(params, leg, Pose{}, leg_rad));
}

void expect_solved(const Params& params, const LegParams& leg, const LegAngles& solved,
                   const Pose& sole) {
  EXPECT_EQ(int{solved.flags}, 0);
  const Pose found = pose_of(params, leg, solved.angle_rad);
  EXPECT_LT(test::distance(found.position_m, sole.position_m), kOff_m);
  for (int k = 0; k < kLegJoints; ++k) {
    const JointParams& joint = model::joint_of(params, leg, k);
    EXPECT_GE(solved.angle_rad[k], joint.lower_rad) << "joint " << k;
    EXPECT_LE(solved.angle_rad[k], joint.upper_rad) << "joint " << k;
  }
}

TEST(LegWithoutAnkleRoll, PutsItsSoleInPlaceWithPitchAndYaw) {
  const Params& params = without(false, true);
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    const LegParams& leg = params.leg[round % 2];
    float leg_rad[kLegJoints], start_rad[kLegJoints];
    random_leg(params, leg, random, leg_rad, start_rad);
    Pose sole = pose_of(params, leg, leg_rad);
    sole.rotation = sole.rotation * math::rot_x(random.between(-0.5F, 0.5F));
    const LegAngles solved = solve_leg(params, leg, sole, start_rad);
    expect_solved(params, leg, solved, sole);
    EXPECT_EQ(solved.angle_rad[kRoll], 0.0F);
    const Vec3 ahead = pose_of(params, leg, solved.angle_rad).rotation.col(0);
    EXPECT_LT(test::distance(ahead, sole.rotation.col(0)), kTurned_rad);
  }
}

TEST(LegWithoutHipYaw, PutsItsSoleInPlaceAsLevelAsAsked) {
  const Params& params = without(true, false);
  Random random(12);
  for (int round = 0; round < 200; ++round) {
    const LegParams& leg = params.leg[round % 2];
    float leg_rad[kLegJoints], start_rad[kLegJoints];
    random_leg(params, leg, random, leg_rad, start_rad);
    Pose sole = pose_of(params, leg, leg_rad);
    sole.rotation = sole.rotation * math::rot_z(random.between(-0.5F, 0.5F));
    const LegAngles solved = solve_leg(params, leg, sole, start_rad);
    expect_solved(params, leg, solved, sole);
    EXPECT_EQ(solved.angle_rad[kYaw], 0.0F);
    const Vec3 up = pose_of(params, leg, solved.angle_rad).rotation.col(2);
    EXPECT_LT(test::distance(up, sole.rotation.col(2)), kTurned_rad);
  }
}

TEST(LegWithoutBoth, PutsItsSoleInPlaceWithToesInTheGround) {
  const Params& params = without(true, true);
  Random random(13);
  for (int round = 0; round < 200; ++round) {
    const LegParams& leg = params.leg[round % 2];
    float leg_rad[kLegJoints], start_rad[kLegJoints];
    random_leg(params, leg, random, leg_rad, start_rad);
    Pose sole = pose_of(params, leg, leg_rad);
    sole.rotation = sole.rotation * math::rot_z(random.between(-0.3F, 0.3F));
    const LegAngles solved = solve_leg(params, leg, sole, start_rad);
    expect_solved(params, leg, solved, sole);
    const Vec3 ahead = pose_of(params, leg, solved.angle_rad).rotation.col(0);
    EXPECT_NEAR(ahead.dot(sole.rotation.col(2)), 0.0F, kTurned_rad);
  }
}

TEST(LegWithoutAnkleRoll, AnyPoseGivesFiniteAngles) {
  Random random(14);
  for (int round = 0; round < 300; ++round) {
    const Params& params = without(round % 3 == 0, round % 3 != 1);
    const LegParams& leg = params.leg[round % 2];
    Pose sole{
        math::rotation_rpy(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)),
        Vec3(random.between(-0.3F, 0.3F), random.between(-0.3F, 0.3F),
             random.between(-0.5F, 0.1F))};
    float start_rad[kLegJoints] = {0, 0, -0.6F, 1.2F, -0.6F, 0};
    if (round % 4 == 0) sole.position_m(round % 3) = test::quiet_nan();
    if (round % 4 == 1) sole.rotation(round % 3, 1) = test::infinity();
    if (round % 4 == 2) start_rad[round % kLegJoints] = test::quiet_nan();
    const LegAngles solved = solve_leg(params, leg, sole, start_rad);
    EXPECT_TRUE(test::all_finite(solved.angle_rad, kLegJoints));
    if (round % 4 < 2) {
      EXPECT_NE(int{solved.flags}, 0);
    }
    if (solved.flags == 0) expect_solved(params, leg, solved, sole);
  }
}

}  // namespace
}  // namespace verp::kinematics
