#include <gtest/gtest.h>

#include "common/kinematics/forward.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

/// About the vertical through the body's origin, from the stand pose, by central differences of all
/// links' positions.
double momentum(const Params& params, const float (&rate_rad_s)[kMaxJoints]) {
  constexpr double kStep_s = 0.01;
  double sum = 0;
  for (int node = 1; node <= params.joint_count; ++node) {
    Eigen::Vector3d at[2];
    for (int side = 0; side < 2; ++side) {
      float angle_rad[kMaxJoints] = {};
      for (int j = 0; j < params.joint_count; ++j) {
        angle_rad[j] = params.joint[j].stand_rad +
                       static_cast<float>(side == 0 ? -kStep_s : kStep_s) * rate_rad_s[j];
      }
      const verp::Pose link = kinematics::node_pose(params, verp::Pose{}, angle_rad, node);
      at[side] = verp::Vec3(math::apply(link, math::to_vec(params.joint[node - 1].com_link_m)))
                     .cast<double>();
    }
    const Eigen::Vector3d velocity = (at[1] - at[0]) / (2 * kStep_s);
    sum += static_cast<double>(params.joint[node - 1].mass_kg) *
           (0.5 * (at[0] + at[1])).cross(velocity).z();
  }
  return sum;
}

double leg_height_m(const Params& params, int side) {
  const LegParams& leg = params.leg[side];
  float stand_rad[kMaxJoints] = {};
  for (int j = 0; j < params.joint_count; ++j) stand_rad[j] = params.joint[j].stand_rad;
  const verp::Pose foot =
      kinematics::node_pose(params, verp::Pose{}, stand_rad, leg.joint[kLegJoints - 1] + 1);
  const verp::Vec3 sole_m = math::apply(foot, math::to_vec(leg.sole_foot_m));
  return static_cast<double>(leg.hip_body_m.z - sole_m.z());
}

// The hips swing the legs apart at 1 m/s; a tenth of the momentum may remain.
TEST(Arms, TurnAgainstTheLegs) {
  for (const char* name : {"generic21", "op3", "darwin_op"}) {
    const Params params = make_params(load_robot(robot_file(name)));
    float rate_rad_s[kMaxJoints] = {};
    for (int side = 0; side < kFeet; ++side) {
      // The hip's y joint: positive is backward.
      for (int k = 0; k < 3; ++k) {
        const int j = params.leg[side].joint[k];
        if (math::abs(params.joint[j].axis.y) < 0.9F) continue;
        const double ahead = side == 0 ? 0.5 : -0.5;
        rate_rad_s[j] =
            -static_cast<float>(ahead / leg_height_m(params, side)) / params.joint[j].axis.y;
      }
    }
    const double legs = momentum(params, rate_rad_s);
    EXPECT_LT(legs, -1e-3) << name;
    for (int side = 0; side < kFeet; ++side) {
      ASSERT_LT(params.arm[side], params.joint_count) << name;
      rate_rad_s[params.arm[side]] = params.arm_rad_per_m[side];
    }
    EXPECT_LT(std::abs(momentum(params, rate_rad_s)), 0.1 * std::abs(legs)) << name;
  }
}

}  // namespace
}  // namespace verp::model
