#include "common/kinematics/leg_ik.hpp"

#include "common/math/elementary.hpp"

namespace verp::kinematics {
namespace {

using math::SinCos;

Pose foot_of_sole(const LegParams& leg, const Pose& sole) {
  Mat3 sole_foot;
  sole_foot << leg.sole_foot[0], leg.sole_foot[1], leg.sole_foot[2], leg.sole_foot[3],
      leg.sole_foot[4], leg.sole_foot[5], leg.sole_foot[6], leg.sole_foot[7], leg.sole_foot[8];
  Pose foot;
  foot.rotation = sole.rotation * sole_foot.transpose();
  foot.position_m = sole.position_m - foot.rotation * math::to_vec(leg.sole_foot_m);
  return foot;
}

// Divides sine and cosine by `norm`. Angle 0 if it is too small.
SinCos unit(float sin, float cos, float norm) {
  constexpr float kLeast = 1e-12F;
  return norm > kLeast ? SinCos{sin / norm, cos / norm} : SinCos{0.0F, 1.0F};
}

// Clamped to the limits. Recomputes sines after clamping, an offset or a failed solution, so that
// no NaN or infinity passes a flag.
void to_joints(const Params& params, const LegParams& leg, const SinCos* canonical,
               LegAngles& result) {
  for (int k = 0; k < kLegJoints; ++k) {
    const JointParams& joint = params.joint[leg.joint[k]];
    const float canonical_rad = math::atan2(canonical[k].sin, canonical[k].cos);
    const float wanted_rad = leg.direction[k] * (canonical_rad - leg.offset_rad[k]);
    const float angle_rad = math::clamp(wanted_rad, joint.lower_rad, joint.upper_rad);
    if (angle_rad != wanted_rad) result.flags |= kJointLimited;
    result.angle_rad[k] = angle_rad;
    result.turn[k] = result.flags != 0 || leg.offset_rad[k] != 0.0F
                         ? math::sincos(angle_rad)
                         : SinCos{leg.direction[k] * canonical[k].sin, canonical[k].cos};
  }
}

SinCos knee_of(const LegParams& leg, float distance_m, LegAngles& result) {
  const float sides_m2 = 2.0F * leg.thigh_m * leg.shank_m;
  const float cos =
      (math::square(distance_m) - math::square(leg.thigh_m) - math::square(leg.shank_m)) / sides_m2;
  if (!(cos <= 1.0F && cos >= -1.0F)) result.flags |= kOutOfReach;
  const float limited = math::clamp(cos, -1.0F, 1.0F);
  return {math::sqrt(1.0F - math::square(limited)), limited};
}

}  // namespace

LegAngles solve_leg_closed_form(const Params& params, const LegParams& leg, const Pose& sole) {
  LegAngles result;
  const Pose foot = foot_of_sole(leg, sole);
  // Ankle roll brings the hip into the leg's plane, ankle pitch onto the shank's side.
  const Vec3 hip_m = foot.rotation.transpose() * (math::to_vec(leg.hip_body_m) - foot.position_m);
  const float height_m = math::hypot(hip_m.y(), hip_m.z());
  const float side = hip_m.z() < 0.0F ? -1.0F : 1.0F;
  const SinCos roll = unit(side * hip_m.y(), side * hip_m.z(), height_m);
  const float along_m = side * height_m;
  const float distance_m = math::hypot(hip_m.x(), height_m);
  const SinCos knee = knee_of(leg, distance_m, result);

  // The hip at zero ankle pitch; the pitch turns it onto (x, along).
  const float bent_x_m = -leg.thigh_m * knee.sin;
  const float bent_z_m = leg.shank_m + leg.thigh_m * knee.cos;
  const float pitch_sin = bent_x_m * along_m - bent_z_m * hip_m.x();
  const float pitch_cos = bent_z_m * along_m + bent_x_m * hip_m.x();
  const SinCos pitch = unit(pitch_sin, pitch_cos, math::hypot(pitch_sin, pitch_cos));

  // The foot's rotation without ankle and knee is the hip's: Rz(yaw) Rx(roll) Ry(pitch).
  const SinCos back_pitch{-(pitch.sin * knee.cos + pitch.cos * knee.sin),
                          pitch.cos * knee.cos - pitch.sin * knee.sin};
  Mat3 level;
  turn_columns(foot.rotation, 1, 2, 0, -roll.sin, roll.cos, level);
  Mat3 hip;
  turn_columns(level, 2, 0, 1, back_pitch.sin, back_pitch.cos, hip);
  const float cos_roll = math::hypot(hip(0, 1), hip(1, 1));
  const SinCos canonical[kLegJoints] = {
      unit(-hip(0, 1), hip(1, 1), cos_roll),
      unit(hip(2, 1), cos_roll, math::hypot(hip(2, 1), cos_roll)),
      unit(-hip(2, 0), hip(2, 2), math::hypot(hip(2, 0), hip(2, 2))),
      knee,
      pitch,
      roll};
  to_joints(params, leg, canonical, result);
  return result;
}

LegAngles solve_leg(const Params& params, const LegParams& leg, const Pose& sole,
                    const float* previous_rad) {
  return leg.solver == LegSolver::kNewton ? solve_leg_newton(params, leg, sole, previous_rad)
                                          : solve_leg_closed_form(params, leg, sole);
}

}  // namespace verp::kinematics
