#include "common/gait/whole_body.hpp"

#include <bit>

#include "common/model/leg.hpp"
#include "common/record/digest.hpp"

namespace verp::gait {
namespace {

std::uint32_t leg_joints(const Params& params) {
  return params.leg[kLeft].solver == LegSolver::kNone
             ? 0
             : model::joints_of(params.leg[kLeft]) | model::joints_of(params.leg[kRight]);
}

// One bit for each joint that carries a joint outside the legs, such as toes. A follower's own
// carriers are not needed: node_pose() goes all the way.
std::uint32_t carriers_of(const Params& params, std::uint32_t legs) {
  std::uint32_t carriers = 0;
  for (int j = params.servo_count() - 1; j >= 0; --j) {
    const int parent = params.joint[j].parent;
    const bool weighed = ((carriers | ~legs) >> j & 1U) != 0;
    if (weighed && parent != 0) carriers |= std::uint32_t{1} << (parent - 1);
  }
  return carriers;
}

}  // namespace

Lump lump_of(const Params& params, const float* angle_rad) {
  const std::uint32_t legs = leg_joints(params), carriers = carriers_of(params, legs);
  union Nodes {  // uninitialised: 33 identities cost more than the arms
    Nodes() {}
    Pose at[kMaxNodes];
  } node;
  node.at[0] = Pose{};
  for (int j = params.servo_count(); j < params.joint_count; ++j) {
    if (((~legs | carriers) >> j & 1U) != 0)
      node.at[j + 1] = kinematics::node_pose(params, Pose{}, angle_rad, j + 1);
  }
  Vec3 moment_kg_m = params.body_mass_kg * math::to_vec(params.body_com_m);
  float mass_kg = params.body_mass_kg;
  for (int j = 0; j < params.joint_count; ++j) {
    if (((legs & ~carriers) >> j & 1U) != 0) continue;
    const JointParams& joint = params.joint[j];
    if (j < params.servo_count()) {
      kinematics::chain(node.at[joint.parent], joint, angle_rad[j], node.at[j + 1]);
    }
    if ((legs >> j & 1U) != 0) continue;
    moment_kg_m += joint.mass_kg * math::apply(node.at[j + 1], math::to_vec(joint.com_link_m));
    mass_kg += joint.mass_kg;
  }
  return {mass_kg, mass_kg > 0.0F ? math::to_xyz(moment_kg_m / mass_kg) : Xyz{}};
}

std::uint32_t digest_load(const Params& params, const float* angle_rad) {
  const std::uint32_t legs = leg_joints(params);
  record::Digest32 digest(legs);
  for (int j = 0; j < params.joint_count; ++j) {
    if ((legs >> j & 1U) == 0) digest.add(std::bit_cast<std::uint32_t>(angle_rad[j]));
  }
  return digest.value();
}

Posture posture_of(const Params& params, const GaitTuning& tuning, Xy body_m, const FootPose& left,
                   const FootPose& right) {
  Posture posture;
  posture.foot[kLeft] = left;
  posture.foot[kRight] = right;
  const float yaw_rad = 0.5F * (left.on.yaw_rad + right.on.yaw_rad);
  const math::SinCos pitch = math::sincos(tuning.trunk_pitch_rad);
  kinematics::turn_columns(math::rot_z(yaw_rad), 2, 0, 1, pitch.sin, pitch.cos,
                           posture.body.rotation);
  const LegParams& leg = params.leg[kLeft];
  const float ankle_m = -leg.sole_foot_m.z;
  const float hip_m = posture.body.rotation.row(2).dot(math::to_vec(leg.hip_body_m));
  posture.body.position_m = {body_m.x, body_m.y, tuning.hip_height_m + ankle_m - hip_m};
  return posture;
}

Pose sole_in_body(const Posture& posture, int side) {
  const FootPose& foot = posture.foot[side];
  const Mat3 into_body = posture.body.rotation.transpose();
  const Vec3 sole_m{foot.on.at_m.x, foot.on.at_m.y, foot.height_m};
  return {into_body * math::rot_z(foot.on.yaw_rad), into_body * (sole_m - posture.body.position_m)};
}

float point_mass_kg(const Params& params, const Lump& lump, int point) {
  if (point == 0) return lump.mass_kg;
  const LegParams& leg = params.leg[(point - 1) / kLegJoints];
  return model::joint_of(params, leg, (point - 1) % kLegJoints).mass_kg;
}

void stand_legs(const Params& params, float* leg_rad) {
  for (const LegParams& leg : params.leg) {
    for (int k = 0; k < kLegJoints; ++k) *leg_rad++ = model::joint_of(params, leg, k).stand_rad;
  }
}

Masses weigh(const Params& params, const Lump& lump, const Posture& posture, float* leg_rad) {
  Masses masses;
  masses.point_m[0] = math::apply(posture.body, math::to_vec(lump.com_body_m));
  Vec3 moment_kg_m = lump.mass_kg * masses.point_m[0];
  float mass_kg = lump.mass_kg;
  Vec3* point_m = masses.point_m + 1;
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params.leg[side];
    float* angle_rad = leg_rad + side * kLegJoints;
    const kinematics::LegAngles solved =
        kinematics::solve_leg(params, leg, sole_in_body(posture, side), angle_rad);
    masses.leg_flags |= solved.flags;
    const bool lost = (solved.flags & kinematics::kNotConverged) != 0;
    for (int k = 0; k < kLegJoints; ++k) {
      angle_rad[k] = lost ? model::joint_of(params, leg, k).stand_rad : solved.angle_rad[k];
    }
    const kinematics::LegChain chain =
        kinematics::leg_chain(params, leg, posture.body, solved.turn);
    for (int k = 0; k < kLegJoints; ++k, ++point_m) {
      const JointParams& joint = model::joint_of(params, leg, k);
      *point_m = math::apply(chain.link[k], math::to_vec(joint.com_link_m));
      moment_kg_m += joint.mass_kg * *point_m;
      mass_kg += joint.mass_kg;
    }
  }
  masses.mass_kg = mass_kg;
  masses.com_m = mass_kg > 0.0F ? Vec3(moment_kg_m / mass_kg) : posture.body.position_m;
  return masses;
}

float com_share(const Params& params, const Lump& lump, const Posture& posture,
                const Masses& masses) {
  const LegParams& leg = params.leg[kLeft];
  const float ankle_m = -leg.sole_foot_m.z;
  const float hip_m = math::apply(posture.body, math::to_vec(leg.hip_body_m)).z();
  const float span_m = math::max(hip_m - ankle_m, 1e-3F);
  float moved_kg = lump.mass_kg;
  float mass_kg = lump.mass_kg;
  for (int point = 1; point < kPoints; ++point) {
    const float share = (masses.point_m[point].z() - ankle_m) / span_m;
    const float point_kg = point_mass_kg(params, lump, point);
    moved_kg += math::clamp(share, 0.0F, 1.0F) * point_kg;
    mass_kg += point_kg;
  }
  return mass_kg > 0.0F ? math::clamp(moved_kg / mass_kg, 0.5F, 1.0F) : 1.0F;
}

}  // namespace verp::gait
