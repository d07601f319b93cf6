#include "common/control/built_in_robot.hpp"

#include <gtest/gtest.h>

#include "common/kinematics/leg_ik.hpp"
#include "tests/unit/control/loop.hpp"

namespace verp::control {
namespace {

const Params& built_in() {
  Params& params = test::changed_robot();
  make_built_in_robot(params);
  return params;
}

// By its joints' parents and origins, as by its closed form.
TEST(BuiltInRobot, StandsAndSitsOnLevelSolesUnderItsHips) {
  const Params& params = built_in();
  for (const LegParams& leg : params.leg) {
    for (const bool sits : {false, true}) {
      float angle_rad[kMaxJoints] = {};
      for (int j = 0; j < params.joint_count; ++j) {
        angle_rad[j] = sits ? params.joint[j].sit_rad : params.joint[j].stand_rad;
      }
      const Pose foot = kinematics::node_pose(params, Pose{}, angle_rad, leg.joint[5] + 1);
      const Pose sole{foot.rotation, math::apply(foot, math::to_vec(leg.sole_foot_m))};
      EXPECT_LT(test::turn_between(sole.rotation, Mat3::Identity()), 1e-5F);
      EXPECT_NEAR(sole.position_m.x(), 0.0F, 1e-6F);
      EXPECT_NEAR(sole.position_m.y(), leg.hip_body_m.y, 1e-6F);
      EXPECT_NEAR(sole.position_m.z(), sits ? -0.2F : -0.27F, 0.02F) << "a small humanoid";
      const auto solved = kinematics::solve_leg(params, leg, sole, nullptr);
      EXPECT_EQ(int{solved.flags}, 0);
      for (int k = 0; k < kLegJoints; ++k) {
        EXPECT_NEAR(solved.angle_rad[k], angle_rad[leg.joint[k]], 1e-4F);
      }
    }
  }
}

TEST(BuiltInRobot, ItsJointsAreThoseOfARobot) {
  const Params& params = built_in();
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const Vec3 axis = math::to_vec(joint.axis);
    EXPECT_EQ(math::norm(axis), 1.0F) << j;
    const Mat3 turned = kinematics::joint_transform(joint, 0.3F).rotation;
    EXPECT_LT(test::turn_between(turned, math::rotation(axis, 0.3F)), 1e-6F) << j;
    EXPECT_EQ(joint.origin_parent_m.y, -params.joint[(j + 6) % 12].origin_parent_m.y) << j;
    EXPECT_EQ(joint.mass_kg, params.joint[(j + 6) % 12].mass_kg) << "legs mirror";
    EXPECT_LT(math::norm(math::to_vec(joint.com_link_m)), 0.093F) << "within its link";
  }
}

}  // namespace
}  // namespace verp::control
