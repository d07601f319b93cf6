#include "common/kinematics/leg_ik.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::kinematics {
namespace {

using test::kRobot;
using test::Random;

constexpr float kPosition_m = 1e-4F;
constexpr float kAngle_rad = 1e-3F;

Pose reached(const Params& params, const LegParams& leg, const LegAngles& angles) {
  return sole_pose(leg, leg_chain(params, leg, Pose{}, angles.angle_rad));
}

void expect_pose(const Pose& found, const Pose& wanted, float position_m = kPosition_m,
                 float angle_rad = kAngle_rad) {
  EXPECT_LT(test::distance(found.position_m, wanted.position_m), position_m);
  EXPECT_LT(test::turn_between(found.rotation, wanted.rotation), angle_rad);
}

void expect_within_limits(const Params& params, const LegParams& leg, const LegAngles& angles) {
  for (int k = 0; k < kLegJoints; ++k) {
    const JointParams& joint = params.joint[leg.joint[k]];
    EXPECT_TRUE(math::is_finite(angles.angle_rad[k])) << "joint " << k;
    EXPECT_GE(angles.angle_rad[k], joint.lower_rad) << "joint " << k;
    EXPECT_LE(angles.angle_rad[k], joint.upper_rad) << "joint " << k;
  }
}

// Hip to ankle is `down_m` long, tilted by roll and pitch.
Pose sole_under_hip(const LegParams& leg, float down_m, float roll_rad, float pitch_rad,
                    const Mat3& sole) {
  const Vec3 hip_ankle = math::rot_x(roll_rad) * (math::rot_y(pitch_rad) * Vec3(0, 0, -down_m));
  return {sole, math::to_vec(leg.hip_body_m) + hip_ankle + sole * math::to_vec(leg.sole_foot_m)};
}

Vec3 ankle_from_hip(const LegParams& leg, const Pose& sole) {
  return sole.position_m - sole.rotation * math::to_vec(leg.sole_foot_m) -
         math::to_vec(leg.hip_body_m);
}

TEST(LegIk, ClosedFormUndoesForwardKinematics) {
  Random random(1);
  for (int round = 0; round < 400; ++round) {
    float angle_rad[kMaxJoints];
    test::random_angles(kRobot, 0.1F, random, angle_rad);
    for (const LegParams& leg : kRobot.leg) {
      const float* leg_rad = angle_rad + leg.joint[0];
      const Pose sole = sole_pose(leg, leg_chain(kRobot, leg, Pose{}, leg_rad));
      const LegAngles solved = solve_leg_closed_form(kRobot, leg, sole);
      expect_pose(reached(kRobot, leg, solved), sole);
      expect_within_limits(kRobot, leg, solved);
    }
  }
}

// Chains take these sines, so they must place the sole to float32 accuracy.
void expect_sines(const Params& params, const LegParams& leg, const LegAngles& solved) {
  for (int k = 0; k < kLegJoints; ++k) {
    const math::SinCos turn = math::sincos(solved.angle_rad[k]);
    EXPECT_NEAR(solved.turn[k].sin, turn.sin, 5e-7F) << "joint " << k;
    EXPECT_NEAR(solved.turn[k].cos, turn.cos, 5e-7F) << "joint " << k;
  }
  const Pose by_sines = sole_pose(leg, leg_chain(params, leg, Pose{}, solved.turn));
  expect_pose(by_sines, reached(params, leg, solved), 5e-7F);
}

TEST(LegIk, SinesAreThoseOfTheAngles) {
  Params offset = kRobot;
  offset.leg[0].offset_rad[2] = offset.leg[1].offset_rad[4] = 0.1F;
  offset.leg[0].direction[3] = offset.leg[1].direction[1] = -1;
  Random random(6);
  for (int round = 0; round < 300; ++round) {
    float angle_rad[kMaxJoints];
    test::random_angles(kRobot, 0.1F, random, angle_rad);
    for (const LegParams& leg : kRobot.leg) {
      const float* leg_rad = angle_rad + leg.joint[0];
      Pose sole = sole_pose(leg, leg_chain(kRobot, leg, Pose{}, leg_rad));
      const LegAngles solved = solve_leg_closed_form(kRobot, leg, sole);
      expect_sines(kRobot, leg, solved);
      expect_pose(sole_pose(leg, leg_chain(kRobot, leg, Pose{}, solved.turn)), sole, 5e-7F);
      const LegParams& other = offset.leg[&leg - kRobot.leg];
      expect_sines(offset, other, solve_leg_closed_form(offset, other, sole));
      expect_sines(kRobot, leg, solve_leg_newton(kRobot, leg, sole, leg_rad));
      sole.position_m.z() -= 0.1F;  // or beyond a limit
      expect_sines(kRobot, leg, solve_leg_closed_form(kRobot, leg, sole));
    }
  }
}

// Any roll solves it.
TEST(LegIk, HipOnTheAnklesRollAxisIsReached) {
  constexpr float kAsked_rad[][kLegJoints] = {
      {-0.211472511F, 0.356358171F, -1.83568692F, 1.61554754F, 0.763026237F, 0.447418749F},
      {-0.556965232F, -0.315718472F, -0.392023325F, 2.04143405F, 0.55008471F, 0.358561039F}};
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = kRobot.leg[side];
    const Pose sole = sole_pose(leg, leg_chain(kRobot, leg, Pose{}, kAsked_rad[side]));
    const LegAngles solved = solve_leg_closed_form(kRobot, leg, sole);
    EXPECT_EQ(int{solved.flags}, 0);
    expect_sines(kRobot, leg, solved);
    expect_pose(reached(kRobot, leg, solved), sole);
  }
}

TEST(LegIk, WalkingPosesAreReachedWithoutFlags) {
  for (float x = -0.06F; x < 0.07F; x += 0.03F) {
    for (float y = -0.02F; y < 0.03F; y += 0.02F) {
      for (float z = -0.16F; z < -0.11F; z += 0.02F) {
        for (float yaw = -0.3F; yaw < 0.4F; yaw += 0.3F) {
          for (const LegParams& leg : kRobot.leg) {
            const Pose sole{math::rot_y(0.05F) * math::rot_z(yaw),
                            math::to_vec(leg.hip_body_m) + Vec3(x, y, z - 0.0335F)};
            const LegAngles solved = solve_leg(kRobot, leg, sole, nullptr);
            EXPECT_EQ(int{solved.flags}, 0) << x << " " << y << " " << z;
            expect_pose(reached(kRobot, leg, solved), sole);
          }
        }
      }
    }
  }
}

TEST(LegIk, MirroredSoleGivesMirroredAngles) {
  Random random(2);
  for (int round = 0; round < 50; ++round) {
    float angle_rad[kMaxJoints];
    test::random_angles(kRobot, 0.1F, random, angle_rad);
    const Pose left = sole_pose(
        kRobot.leg[0], leg_chain(kRobot, kRobot.leg[0], Pose{}, angle_rad + test::kLeftLeg));
    const LegAngles a = solve_leg_closed_form(kRobot, kRobot.leg[0], left);
    const LegAngles b = solve_leg_closed_form(kRobot, kRobot.leg[1], test::mirrored(left));
    for (int k = 0; k < kLegJoints; ++k) {
      const float sign = test::kRows[test::kLeftLeg + k].axis == AxisKind::kY ? 1.0F : -1.0F;
      EXPECT_NEAR(a.angle_rad[k], sign * b.angle_rad[k], 1e-5F) << "joint " << k;
    }
  }
}

TEST(LegIk, NewtonAgreesWithTheClosedForm) {
  Random random(3);
  for (int round = 0; round < 60; ++round) {
    float angle_rad[kMaxJoints];
    test::random_angles(kRobot, 0.4F, random, angle_rad);
    for (const LegParams& leg : kRobot.leg) {
      float* leg_rad = angle_rad + leg.joint[0];
      const Pose sole = sole_pose(leg, leg_chain(kRobot, leg, Pose{}, leg_rad));
      for (int k = 0; k < kLegJoints; ++k) leg_rad[k] += random.between(-0.05F, 0.05F);
      const LegAngles newton = solve_leg_newton(kRobot, leg, sole, leg_rad);
      const LegAngles closed = solve_leg_closed_form(kRobot, leg, sole);
      EXPECT_EQ(newton.flags & kNotConverged, 0);
      expect_pose(reached(kRobot, leg, newton), sole);
      expect_pose(reached(kRobot, leg, newton), reached(kRobot, leg, closed));
    }
  }
}

TEST(LegIk, NewtonFollowsAPathWhereAxesDoNotMeet) {
  const Params params = test::make_offset_robot();
  for (const LegParams& leg : params.leg) {
    float previous_rad[kLegJoints] = {0, 0, -0.6F, 1.2F, -0.6F, 0};
    const Pose start = sole_pose(leg, leg_chain(params, leg, Pose{}, previous_rad));
    for (int i = 0; i <= 60; ++i) {
      const float u = static_cast<float>(i) / 60;
      Pose sole = start;
      sole.position_m += Vec3(0.06F * u, 0.01F * u, 0.03F * u * (1 - u));
      sole.rotation = start.rotation * math::rot_z(0.2F * u);
      const LegAngles solved = solve_leg(params, leg, sole, previous_rad);
      EXPECT_EQ(int{solved.flags}, 0) << "at " << u;
      expect_pose(reached(params, leg, solved), sole);
      for (int k = 0; k < kLegJoints; ++k) {
        EXPECT_LT(math::abs(solved.angle_rad[k] - previous_rad[k]), 0.1F) << "a jump at " << u;
        previous_rad[k] = solved.angle_rad[k];
      }
    }
  }
}

// Same direction from the hip, same orientation.
TEST(LegIk, BeyondReachTheLegIsStraightTowardsTheTarget) {
  for (const LegParams& leg : kRobot.leg) {
    for (const float roll : {-0.2F, 0.0F, 0.2F}) {
      for (const float pitch : {-0.3F, 0.0F, 0.3F}) {
        const Pose sole = sole_under_hip(leg, 0.25F, roll, pitch, math::rot_z(0.1F));
        const LegAngles solved = solve_leg(kRobot, leg, sole, nullptr);
        EXPECT_EQ(int{solved.flags}, int{kOutOfReach});
        EXPECT_NEAR(solved.angle_rad[3], 0.0F, kAngle_rad);
        const Pose found = reached(kRobot, leg, solved);
        EXPECT_LT(test::turn_between(found.rotation, sole.rotation), kAngle_rad);
        const Vec3 asked = ankle_from_hip(leg, sole), got = ankle_from_hip(leg, found);
        EXPECT_NEAR(math::norm(got), leg.thigh_m + leg.shank_m, kPosition_m);
        EXPECT_LT(math::norm(math::cross(asked, got)) / (math::norm(asked) * math::norm(got)),
                  kAngle_rad);
        EXPECT_GT(asked.dot(got), 0.0F);
      }
    }
  }
}

// Nearer than shank minus thigh.
TEST(LegIk, TooNearIsFlagged) {
  Params params = kRobot;
  params.leg[0].shank_m = 0.06F;
  params.joint[test::kLeftLeg + 4].origin_parent_m.z = -0.06F;
  const Pose sole = sole_under_hip(params.leg[0], 0.01F, 0, 0, Mat3::Identity());
  const LegAngles solved = solve_leg(params, params.leg[0], sole, nullptr);
  EXPECT_NE(solved.flags & kOutOfReach, 0);
  expect_within_limits(params, params.leg[0], solved);
  EXPECT_EQ(solved.angle_rad[3], params.joint[test::kLeftLeg + 3].upper_rad);
}

// The foot points at the hip: no roll is better than another.
TEST(LegIk, FootThatPointsAtItsHipIsReached) {
  Mat3 down;
  down << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  for (const LegParams& leg : kRobot.leg) {
    const Pose sole = sole_under_hip(leg, 0.15F, 0, 0, down);
    Params params = kRobot;
    for (int k = 0; k < kLegJoints; ++k) params.joint[leg.joint[k]].lower_rad = -4;
    for (int k = 0; k < kLegJoints; ++k) params.joint[leg.joint[k]].upper_rad = 4;
    const LegAngles solved = solve_leg_closed_form(params, leg, sole);
    EXPECT_EQ(int{solved.flags}, 0);
    expect_sines(params, leg, solved);
    expect_pose(reached(params, leg, solved), sole);
  }
}

TEST(LegIk, StraightKneeIsNoSingularity) {
  const LegParams& leg = kRobot.leg[0];
  const float reach_m = leg.thigh_m + leg.shank_m;
  LegAngles previous;
  for (int i = -20; i <= 20; ++i) {
    const float down_m = reach_m * (1.0F + 1e-6F * static_cast<float>(i));
    const Pose sole = sole_under_hip(leg, down_m, 0.1F, -0.1F, Mat3::Identity());
    const LegAngles solved = solve_leg(kRobot, leg, sole, nullptr);
    expect_within_limits(kRobot, leg, solved);
    expect_pose(reached(kRobot, leg, solved), sole);
    for (int k = 0; i > -20 && k < kLegJoints; ++k) {
      EXPECT_NEAR(solved.angle_rad[k], previous.angle_rad[k], 5e-3F) << "joint " << k;
    }
    previous = solved;
  }
}

TEST(LegIk, NewtonNearTheStraightKneeStaysFinite) {
  const LegParams& leg = kRobot.leg[0];
  const float straight_rad[kLegJoints] = {};
  for (const float down_m : {0.10F, 0.18F, 0.186F, 0.19F, 0.4F}) {
    const Pose sole = sole_under_hip(leg, down_m, 0, 0, Mat3::Identity());
    expect_within_limits(kRobot, leg, solve_leg_newton(kRobot, leg, sole, straight_rad));
  }
}

TEST(LegIk, JointLimitsAreKeptAndFlagged) {
  Params params = kRobot;
  params.joint[test::kLeftLeg + 3].upper_rad = 1.0F;
  const LegParams& leg = params.leg[0];
  const Pose sole = sole_under_hip(leg, 0.10F, 0, 0, Mat3::Identity());
  const LegAngles closed = solve_leg_closed_form(params, leg, sole);
  EXPECT_EQ(int{closed.flags}, int{kJointLimited});
  EXPECT_EQ(closed.angle_rad[3], 1.0F);
  const float start_rad[kLegJoints] = {0, 0, -0.5F, 0.9F, -0.5F, 0};
  const LegAngles newton = solve_leg_newton(params, leg, sole, start_rad);
  EXPECT_NE(newton.flags, 0);
  expect_within_limits(params, leg, newton);
}

TEST(LegIk, AnyPoseIsReachedOrFlagged) {
  Random random(4);
  for (int round = 0; round < 300; ++round) {
    const LegParams& leg = kRobot.leg[round % 2];
    const Pose sole{
        math::rotation_rpy(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)),
        Vec3(random.between(-0.3F, 0.3F), random.between(-0.3F, 0.3F),
             random.between(-0.5F, 0.1F))};
    const float start_rad[kLegJoints] = {0, 0, -0.6F, 1.2F, -0.6F, 0};
    for (const LegAngles& solved : {solve_leg_closed_form(kRobot, leg, sole),
                                    solve_leg_newton(kRobot, leg, sole, start_rad)}) {
      expect_within_limits(kRobot, leg, solved);
      if (solved.flags == 0) expect_pose(reached(kRobot, leg, solved), sole);
    }
  }
}

TEST(LegIk, PosesThatAreNoPosesGiveFiniteAnglesAndAFlag) {
  const float start_rad[kLegJoints] = {0, 0, -0.6F, 1.2F, -0.6F, 0};
  const LegParams& leg = kRobot.leg[0];
  for (const float bad : {test::quiet_nan(), test::infinity(), -test::infinity()}) {
    for (int where = 0; where < 12; ++where) {
      Pose sole = sole_under_hip(leg, 0.15F, 0, 0, Mat3::Identity());
      (where < 3 ? sole.position_m(where) : sole.rotation((where - 3) / 3, where % 3)) = bad;
      const LegAngles closed = solve_leg_closed_form(kRobot, leg, sole);
      const LegAngles newton = solve_leg_newton(kRobot, leg, sole, start_rad);
      expect_within_limits(kRobot, leg, closed);
      expect_within_limits(kRobot, leg, newton);
      for (int k = 0; k < kLegJoints; ++k) {
        EXPECT_TRUE(math::is_finite(closed.turn[k].sin) && math::is_finite(closed.turn[k].cos));
        EXPECT_TRUE(math::is_finite(newton.turn[k].sin) && math::is_finite(newton.turn[k].cos));
      }
      EXPECT_NE(int{newton.flags}, 0) << bad << " at " << where;
      EXPECT_NE(int{closed.flags}, 0) << bad << " at " << where;
    }
  }
}

TEST(LegIk, WarmStartOfNoNumbersIsHarmless) {
  float start_rad[kLegJoints];
  for (float& angle : start_rad) angle = test::quiet_nan();
  const Pose sole = sole_under_hip(kRobot.leg[0], 0.15F, 0, 0, Mat3::Identity());
  expect_within_limits(kRobot, kRobot.leg[0],
                       solve_leg_newton(kRobot, kRobot.leg[0], sole, start_rad));
}

// Links of any length, joints about minus axes, a sole turned on its foot.
TEST(LegIk, ClosedFormSolvesEveryLegThatItsAxesAllow) {
  static Params params;
  params = kRobot;
  LegParams& leg = params.leg[0];
  Random random(8);
  for (int round = 0; round < 100; ++round) {
    JointParams* const joint = params.joint + test::kLeftLeg;
    leg.hip_body_m = {random.between(-0.1F, 0.1F), random.between(-0.1F, 0.1F), 0.02F};
    leg.thigh_m = random.between(0.06F, 0.12F);
    leg.shank_m = random.between(0.06F, 0.12F);
    joint[0].origin_parent_m = leg.hip_body_m;
    joint[3].origin_parent_m.z = -leg.thigh_m;
    joint[4].origin_parent_m.z = -leg.shank_m;
    const Mat3 turn =
        math::rotation_rpy(random.between(-3, 3), random.between(-1, 1), random.between(-3, 3));
    for (int i = 0; i < 9; ++i) leg.sole_foot[i] = turn(i / 3, i % 3);
    leg.sole_foot_m = {random.between(-0.03F, 0.03F), random.between(-0.03F, 0.03F), -0.03F};
    float leg_rad[kLegJoints];
    for (int k = 0; k < kLegJoints; ++k) {
      leg.direction[k] = random.below(2) == 0 ? 1 : -1;
      joint[k].axis_kind = AxisKind::kGeneral;
      joint[k].axis =
          math::to_xyz(leg.direction[k] * math::to_vec(kRobot.joint[leg.joint[k]].axis));
      joint[k].lower_rad = -3;
      joint[k].upper_rad = 3;
      leg_rad[k] =
          leg.direction[k] * (k == 3 ? random.between(0.3F, 2.0F) : random.between(-0.7F, 0.7F));
    }
    const Pose sole = sole_pose(leg, leg_chain(params, leg, Pose{}, leg_rad));
    const LegAngles solved = solve_leg_closed_form(params, leg, sole);
    EXPECT_EQ(int{solved.flags}, 0) << round;
    for (int k = 0; k < kLegJoints; ++k) EXPECT_NEAR(solved.angle_rad[k], leg_rad[k], 1e-3F) << k;
  }
}

}  // namespace
}  // namespace verp::kinematics
