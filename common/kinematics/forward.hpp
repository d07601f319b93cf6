#pragma once
#include "common/math/linear.hpp"
#include "common/model/params.hpp"

/// Forward kinematics by the chain rule of the paper: p = p0 + R0 p1, R = R0 R1, from the body
/// outwards. All functions take joint angles in rad, indexed as Params::joint, and work in the
/// frame in which `body` is given.
namespace verp::kinematics {

/// Pose of the link that `joint` moves, seen from its parent link, at `angle_rad`.
Pose joint_transform(const JointParams& joint, float angle_rad);

/// Turns two columns of `from` in the plane of their axes and keeps the third: what a product with
/// rot_x (1, 2, 0), rot_y (2, 0, 1) or rot_z (0, 1, 2) leaves to do.
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

/// link = parent * joint_transform, without the multiplications by zero and one of an axis along x,
/// y or z.
void chain(const Pose& parent, const JointParams& joint, const math::SinCos& turn, Pose& link);
inline void chain(const Pose& parent, const JointParams& joint, float angle_rad, Pose& link) {
  chain(parent, joint, math::sincos(angle_rad), link);
}

/// Pose of one node: recursive, from the node up to the body.
Pose node_pose(const Params& params, const Pose& body, const float* angle_rad, int node);

/// Poses of all nodes 0..joint_count, in one pass; `node` holds at least that many.
void all_poses(const Params& params, const Pose& body, const float* angle_rad, Pose* node);

/// Centre of mass of the whole robot.
Vec3 center_of_mass(const Params& params, const Pose& body, const float* angle_rad);

/// Joint axis in the outer frame, given the pose of the link that the joint moves (the axis is
/// fixed in it).
Vec3 joint_axis(const JointParams& joint, const Mat3& link_rotation);

/// Chain of one leg: poses of its six links, hip to ankle, in the body frame's outer frame. By the
/// joints' sines where they are known (LegAngles::turn), else by their angles; both are indexed by
/// position in the leg.
struct LegChain {
  Pose link[kLegJoints] = {Pose(math::Unset{}), Pose(math::Unset{}), Pose(math::Unset{}),
                           Pose(math::Unset{}), Pose(math::Unset{}), Pose(math::Unset{})};
};
LegChain leg_chain(const Params& params, const LegParams& leg, const Pose& body,
                   const math::SinCos* turn);
LegChain leg_chain(const Params& params, const LegParams& leg, const Pose& body,
                   const float* leg_angle_rad);

/// The sole frame at the end of a leg.
Pose sole_pose(const LegParams& leg, const LegChain& chain);

/// 6 x 6 Jacobian of the sole: rows 0-2 linear (m/rad), rows 3-5 angular (rad/rad), columns hip to
/// ankle.
Mat6 leg_jacobian(const Params& params, const LegParams& leg, const LegChain& chain,
                  const Vec3& sole_m);

}  // namespace verp::kinematics
