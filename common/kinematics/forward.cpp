#include "common/kinematics/forward.hpp"

#include "common/math/elementary.hpp"
#include "common/model/leg.hpp"

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

// Skips zeros: most joints sit on an axis of their parent.
inline void place(const Pose& parent, const Xyz& origin_m, Vec3& position_m) {
  position_m = parent.position_m;
  if (origin_m.x != 0.0F) position_m += origin_m.x * parent.rotation.col(0);
  if (origin_m.y != 0.0F) position_m += origin_m.y * parent.rotation.col(1);
  if (origin_m.z != 0.0F) position_m += origin_m.z * parent.rotation.col(2);
}

}  // namespace

Pose joint_transform(const JointParams& joint, float angle_rad) {
  return {axis_rotation(joint, angle_rad), math::to_vec(joint.origin_parent_m)};
}

void chain(const Pose& parent, const JointParams& joint, const math::SinCos& turn, Pose& link) {
  place(parent, joint.origin_parent_m, link.position_m);
  const Mat3& from = parent.rotation;
  Mat3& to = link.rotation;
  switch (joint.axis_kind) {
    case AxisKind::kX:
      return turn_columns(from, 1, 2, 0, turn.sin, turn.cos, to);
    case AxisKind::kY:
      return turn_columns(from, 2, 0, 1, turn.sin, turn.cos, to);
    case AxisKind::kZ:
      return turn_columns(from, 0, 1, 2, turn.sin, turn.cos, to);
    case AxisKind::kMinusX:
      return turn_columns(from, 1, 2, 0, -turn.sin, turn.cos, to);
    case AxisKind::kMinusY:
      return turn_columns(from, 2, 0, 1, -turn.sin, turn.cos, to);
    case AxisKind::kMinusZ:
      return turn_columns(from, 0, 1, 2, -turn.sin, turn.cos, to);
    case AxisKind::kGeneral:
      break;
  }
  to = from * math::rotation(math::to_vec(joint.axis), turn);
}

Pose node_pose(const Params& params, const Pose& body, const float* angle_rad, int node) {
  // A recursion would have no stack bound.
  int path[kMaxJoints];
  int length = 0;
  for (; node != 0 && length < kMaxJoints; node = params.joint[node - 1].parent) {
    path[length++] = node;
  }
  Pose pose = body;
  while (length > 0) {
    const int each = path[--length] - 1;
    const Pose parent = pose;
    chain(parent, params.joint[each], angle_rad[each], pose);
  }
  return pose;
}

void all_poses(const Params& params, const Pose& body, const float* angle_rad, Pose* node) {
  node[0] = body;
  // Followers come last but may carry earlier joints.
  for (int j = params.servo_count(); j < params.joint_count; ++j) {
    node[j + 1] = node_pose(params, body, angle_rad, j + 1);
  }
  for (int j = 0; j < params.servo_count(); ++j) {
    chain(node[params.joint[j].parent], params.joint[j], angle_rad[j], node[j + 1]);
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
                   const math::SinCos* turn) {
  LegChain legs;
  const Pose* parent = &body;
  for (int k = 0; k < kLegJoints; ++k) {
    chain(*parent, model::joint_of(params, leg, k), turn[k], legs.link[k]);
    parent = &legs.link[k];
  }
  return legs;
}

LegChain leg_chain(const Params& params, const LegParams& leg, const Pose& body,
                   const float* leg_angle_rad) {
  math::SinCos turn[kLegJoints];
  for (int k = 0; k < kLegJoints; ++k) turn[k] = math::sincos(leg_angle_rad[k]);
  return leg_chain(params, leg, body, turn);
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
    const Vec3 axis = joint_axis(model::joint_of(params, leg, k), chain.link[k].rotation);
    jacobian.col(k) << math::cross(axis, sole_m - chain.link[k].position_m), axis;
  }
  return jacobian;
}

}  // namespace verp::kinematics
