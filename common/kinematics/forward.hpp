#pragma once
#include "common/math/linear.hpp"
#include "common/model/params.hpp"

/// The paper's chain rule, outwards: p = p0 + R0 p1, R = R0 R1. Joint angles are in rad, indexed as
/// Params::joint; results are in the frame of `body`.
namespace verp::kinematics {

/// Pose of the joint's link in its parent link.
Pose joint_transform(const JointParams& joint, float angle_rad);

/// The product with rot_x (1, 2, 0), rot_y (2, 0, 1) or rot_z (0, 1, 2).
inline void turn_columns(const Mat3& from, int first, int second, int kept, float sin, float cos,
                         Mat3& to) {
  for (int row = 0; row < 3; ++row) {
    const float a = from(row, first);
    const float b = from(row, second);
    to(row, first) = cos * a + sin * b;
    to(row, second) = cos * b - sin * a;
    to(row, kept) = from(row, kept);
  }
}

/// link = parent * joint_transform, faster for axes along x, y or z.
void chain(const Pose& parent, const JointParams& joint, const math::SinCos& turn, Pose& link);
inline void chain(const Pose& parent, const JointParams& joint, float angle_rad, Pose& link) {
  chain(parent, joint, math::sincos(angle_rad), link);
}

Pose node_pose(const Params& params, const Pose& body, const float* angle_rad, int node);

/// Poses of nodes 0..joint_count.
void all_poses(const Params& params, const Pose& body, const float* angle_rad, Pose* node);

Vec3 center_of_mass(const Params& params, const Pose& body, const float* angle_rad);

/// Joint axis from the rotation of the link that the joint moves.
Vec3 joint_axis(const JointParams& joint, const Mat3& link_rotation);

/// Poses of a leg's six links, hip to ankle, in the frame of `body`, from the joints' sines if
/// known (LegAngles::turn), else their angles.
struct LegChain {
  Pose link[kLegJoints] = {Pose(math::Unset{}), Pose(math::Unset{}), Pose(math::Unset{}),
                           Pose(math::Unset{}), Pose(math::Unset{}), Pose(math::Unset{})};
};
LegChain leg_chain(const Params& params, const LegParams& leg, const Pose& body,
                   const math::SinCos* turn);
LegChain leg_chain(const Params& params, const LegParams& leg, const Pose& body,
                   const float* leg_angle_rad);

Pose sole_pose(const LegParams& leg, const LegChain& chain);

/// 6 x 6: rows 0-2 linear (m/rad), rows 3-5 angular (rad/rad); columns hip to ankle.
Mat6 leg_jacobian(const Params& params, const LegParams& leg, const LegChain& chain,
                  const Vec3& sole_m);

}  // namespace verp::kinematics
