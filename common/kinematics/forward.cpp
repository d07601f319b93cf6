#include "common/kinematics/forward.hpp"

#include "common/math/elementary.hpp"

namespace verp::kinematics {
namespace {

Mat3 axis_rotation(const JointParams& joint, float angle_rad) {
  const math::SinCos angle = math::sincos(angle_rad);
  const math::SinCos reverse{-angle.sin, angle.cos};
  switch (joint.axis_kind) {
    case AxisKind::kX:
      return math::rot_x(angle);
    case AxisKind::kY:
      return math::rot_y(angle);
    case AxisKind::kZ:
      return math::rot_z(angle);
    case AxisKind::kMinusX:
      return math::rot_x(reverse);
    case AxisKind::kMinusY:
      return math::rot_y(reverse);
    case AxisKind::kMinusZ:
      return math::rot_z(reverse);
    case AxisKind::kGeneral:
      break;
  }
  return math::rotation(math::to_vec(joint.axis), angle);
}

// Turns the columns of `m` in the plane of two axes: what a product with rot_x, rot_y or rot_z
// leaves to do.
void turn_columns(Mat3& m, int first, int second, float sin, float cos) {
  const Vec3 a = m.col(first);
  const Vec3 b = m.col(second);
  m.col(first) = cos * a + sin * b;
  m.col(second) = cos * b - sin * a;
}

}  // namespace

Pose joint_transform(const JointParams& joint, float angle_rad) {
  return {axis_rotation(joint, angle_rad), math::to_vec(joint.origin_parent_m)};
}

Pose chain(const Pose& parent, const JointParams& joint, float angle_rad) {
  Pose pose{parent.rotation,
            parent.position_m + parent.rotation * math::to_vec(joint.origin_parent_m)};
  const math::SinCos angle = math::sincos(angle_rad);
  switch (joint.axis_kind) {
    case AxisKind::kX:
      turn_columns(pose.rotation, 1, 2, angle.sin, angle.cos);
      break;
    case AxisKind::kY:
      turn_columns(pose.rotation, 2, 0, angle.sin, angle.cos);
      break;
    case AxisKind::kZ:
      turn_columns(pose.rotation, 0, 1, angle.sin, angle.cos);
      break;
    case AxisKind::kMinusX:
      turn_columns(pose.rotation, 1, 2, -angle.sin, angle.cos);
      break;
    case AxisKind::kMinusY:
      turn_columns(pose.rotation, 2, 0, -angle.sin, angle.cos);
      break;
    case AxisKind::kMinusZ:
      turn_columns(pose.rotation, 0, 1, -angle.sin, angle.cos);
      break;
    case AxisKind::kGeneral:
      pose.rotation = pose.rotation * math::rotation(math::to_vec(joint.axis), angle);
      break;
  }
  return pose;
}

Pose node_pose(const Params& params, const Pose& body, const float* angle_rad, int node) {
  if (node == 0) return body;
  const JointParams& joint = params.joint[node - 1];
  return chain(node_pose(params, body, angle_rad, joint.parent), joint, angle_rad[node - 1]);
}

void all_poses(const Params& params, const Pose& body, const float* angle_rad, Pose* node) {
  node[0] = body;
  for (int j = 0; j < params.joint_count; ++j) {
    node[j + 1] = chain(node[params.joint[j].parent], params.joint[j], angle_rad[j]);
  }
}

Vec3 center_of_mass(const Params& params, const Pose& body, const float* angle_rad) {
  Pose node[kMaxNodes];
  all_poses(params, body, angle_rad, node);
  Vec3 moment_kg_m = params.body_mass_kg * math::apply(body, math::to_vec(params.body_com_m));
  float mass_kg = params.body_mass_kg;
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    moment_kg_m += joint.mass_kg * math::apply(node[j + 1], math::to_vec(joint.com_link_m));
    mass_kg += joint.mass_kg;
  }
  return mass_kg > 0.0F ? Vec3(moment_kg_m / mass_kg) : body.position_m;
}

Vec3 joint_axis(const JointParams& joint, const Mat3& link_rotation) {
  switch (joint.axis_kind) {
    case AxisKind::kX:
      return link_rotation.col(0);
    case AxisKind::kY:
      return link_rotation.col(1);
    case AxisKind::kZ:
      return link_rotation.col(2);
    case AxisKind::kMinusX:
      return -link_rotation.col(0);
    case AxisKind::kMinusY:
      return -link_rotation.col(1);
    case AxisKind::kMinusZ:
      return -link_rotation.col(2);
    case AxisKind::kGeneral:
      break;
  }
  return link_rotation * math::to_vec(joint.axis);
}

LegChain leg_chain(const Params& params, const LegParams& leg, const Pose& body,
                   const float* leg_angle_rad) {
  LegChain result;
  const Pose* parent = &body;
  for (int k = 0; k < kLegJoints; ++k) {
    result.link[k] = chain(*parent, params.joint[leg.joint[k]], leg_angle_rad[k]);
    parent = &result.link[k];
  }
  return result;
}

Pose sole_pose(const LegParams& leg, const LegChain& chain) {
  const Pose& foot = chain.link[kLegJoints - 1];
  Mat3 sole;
  sole << leg.sole_foot[0], leg.sole_foot[1], leg.sole_foot[2], leg.sole_foot[3], leg.sole_foot[4],
      leg.sole_foot[5], leg.sole_foot[6], leg.sole_foot[7], leg.sole_foot[8];
  return {foot.rotation * sole, math::apply(foot, math::to_vec(leg.sole_foot_m))};
}

Mat6 leg_jacobian(const Params& params, const LegParams& leg, const LegChain& chain,
                  const Vec3& sole_m) {
  Mat6 jacobian;
  for (int k = 0; k < kLegJoints; ++k) {
    const Vec3 axis = joint_axis(params.joint[leg.joint[k]], chain.link[k].rotation);
    jacobian.col(k) << math::cross(axis, sole_m - chain.link[k].position_m), axis;
  }
  return jacobian;
}

}  // namespace verp::kinematics
