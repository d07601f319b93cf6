#include "common/kinematics/leg_ik.hpp"
#include "common/model/leg.hpp"

namespace verp::kinematics {
namespace {

constexpr int kIterations = 4;            // two were enough on all legs tried
constexpr float kMetresPerRadian = 0.1F;  // weighs angle against length errors
constexpr float kDamping = 1e-6F;         // m^2; bounds the step at a straight knee
constexpr float kMaxStepRad = 0.3F;       // a larger step leaves the linear range
constexpr float kPositionTolerance_m = 1e-4F;
constexpr float kAngleTolerance_rad = 1e-3F;

struct Residual {
  Vec3 position_m;
  Vec3 rotation_rad;
  bool small() const {
    return math::norm(position_m) < kPositionTolerance_m &&
           math::norm(rotation_rad) < kAngleTolerance_rad;
  }
};

// Without hip yaw the sole turns about its vertical as the leg gives it, without ankle roll about
// its length, as if the ground were the joint: that part of the error is free.
struct Free {
  std::uint8_t slot, axis;
};
constexpr Free kFree[] = {{0, 2}, {kLegJoints - 1, 0}};

Residual residual_of(const LegParams& leg, const Pose& wanted, const Pose& reached) {
  Vec3 turn = math::rotation_vector(wanted.rotation * reached.rotation.transpose());
  for (const Free& free : kFree) {
    const Vec3 from = reached.rotation.col(free.axis), to = wanted.rotation.col(free.axis);
    if (!model::has(leg, free.slot) && from.dot(to) > 0.0F) turn = math::cross(from, to);
  }
  if (!model::has(leg, 0)) turn -= turn.dot(wanted.rotation.col(2)) * wanted.rotation.col(2);
  return {wanted.position_m - reached.position_m, turn};
}

// J^T J + damping and J^T e with scaled angular rows. Written out, because Eigen may use a blocked
// product.
bool newton_step(const Mat6& jacobian, const Residual& residual, Vec6& step_rad) {
  Mat6 scaled;
  Vec6 error;
  for (int k = 0; k < kLegJoints; ++k) {
    scaled.col(k) << jacobian.col(k).head<3>(), kMetresPerRadian * jacobian.col(k).tail<3>();
  }
  error << residual.position_m, kMetresPerRadian * residual.rotation_rad;
  Mat6 normal;
  Vec6 right;
  for (int i = 0; i < kLegJoints; ++i) {
    for (int j = 0; j <= i; ++j) {
      normal(i, j) = scaled.col(i).dot(scaled.col(j)) + (i == j ? kDamping : 0.0F);
      normal(j, i) = normal(i, j);
    }
    right(i) = scaled.col(i).dot(error);
  }
  return math::solve_spd(normal, right, step_rad);
}

// math::norm() of NaN is 0 and would look solved.
bool is_pose(const Pose& sole) {
  return math::is_finite(sole.rotation.sum() + sole.position_m.sum());
}

}  // namespace

LegAngles solve_leg_newton(const Params& params, const LegParams& leg, const Pose& sole,
                           const float* previous_rad) {
  LegAngles result;
  for (int k = 0; k < kLegJoints; ++k) {
    const JointParams& joint = model::joint_of(params, leg, k);
    result.angle_rad[k] = math::clamp(previous_rad[k], joint.lower_rad, joint.upper_rad);
    result.turn[k] = math::sincos(result.angle_rad[k]);
  }
  if (!is_pose(sole)) {
    result.flags = kNotConverged;
    return result;
  }
  for (int i = 0; i <= kIterations; ++i) {
    const LegChain legs = leg_chain(params, leg, Pose{}, result.turn);
    const Pose reached = sole_pose(leg, legs);
    const Residual residual = residual_of(leg, sole, reached);
    if (residual.small()) return result;
    Vec6 step_rad;
    if (i == kIterations) break;
    Mat6 jacobian = leg_jacobian(params, leg, legs, reached.position_m);
    for (const Free& free : kFree) {
      if (!model::has(leg, free.slot))
        jacobian.col(free.slot).tail<3>() = sole.rotation.col(free.axis);
    }
    if (!newton_step(jacobian, residual, step_rad)) break;
    result.flags = 0;
    for (int k = 0; k < kLegJoints; ++k) {
      if (!model::has(leg, k)) continue;
      const JointParams& joint = params.joint[leg.joint[k]];
      const float wanted_rad =
          result.angle_rad[k] + math::clamp(step_rad(k), -kMaxStepRad, kMaxStepRad);
      result.angle_rad[k] = math::clamp(wanted_rad, joint.lower_rad, joint.upper_rad);
      result.turn[k] = math::sincos(result.angle_rad[k]);
      if (result.angle_rad[k] != wanted_rad) result.flags |= kJointLimited;
    }
  }
  result.flags |= kNotConverged;
  return result;
}

}  // namespace verp::kinematics
