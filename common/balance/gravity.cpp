#include "common/balance/gravity.hpp"

#include "common/model/leg.hpp"

namespace verp::balance {

Vec3 ground_point(const LegParams& leg, const gait::FootPose& foot, gait::Xy zmp_m) {
  const math::SinCos yaw = math::sincos(foot.on.yaw_rad);
  const gait::Xy in_sole = gait::turned(zmp_m - foot.on.at_m, {-yaw.sin, yaw.cos});
  const gait::Xy inside{math::clamp(in_sole.x, -leg.sole_back_m, leg.sole_front_m),
                        math::clamp(in_sole.y, -leg.sole_right_m, leg.sole_left_m)};
  const gait::Xy at_m = foot.on.at_m + gait::turned(inside, yaw);
  return {at_m.x, at_m.y, foot.height_m};
}

LegMotion follow(const Params& params, int side, const float* leg_rad, DriveState& state) {
  const float period_s = static_cast<float>(params.period_us) * 1e-6F;
  LegMotion motion;
  for (int k = 0; k < kLegJoints; ++k) {
    float& last_rad = state.angle_rad[side * kLegJoints + k];
    float& last_rad_s = state.rate_rad_s[side * kLegJoints + k];
    const float rate = (leg_rad[k] - last_rad) / period_s;
    const JointParams& joint = model::joint_of(params, params.leg[side], k);
    if (math::abs(rate) <= joint.velocity_limit_rad_s) {
      motion.rate_rad_s[k] = rate;
      motion.accel_rad_s2[k] = (rate - last_rad_s) / period_s;
    }
    last_rad = leg_rad[k];
    last_rad_s = motion.rate_rad_s[k];
  }
  return motion;
}

namespace {

// Torque for rotor and gears. Friction changes sign smoothly: a joint near rest may turn either
// way.
float taken_nm(const BalanceTuning& tuning, const JointParams& joint, float load_nm, float rate,
               float accel) {
  constexpr float kSure_rad_s = 0.1F;
  const float slow = 1.0F / (1.0F + math::square(rate / joint.friction_speed_rad_s));
  // Load and motor press on opposite sides of the gears.
  const float budget =
      slow * (joint.friction_n_m + 2.0F * joint.load_friction * math::abs(load_nm));
  return tuning.inertia_share * joint.armature_kg_m2 * accel +
         tuning.friction_share * budget * rate / (math::abs(rate) + kSure_rad_s);
}

}  // namespace

void add_sag(const Params& params, const BalanceTuning& tuning, const LegParams& leg,
             const kinematics::LegChain& chain, const LegLoad& load, const LegMotion& motion,
             float* leg_rad) {
  Vec3 force_n = load.push_n;
  Vec3 moment_nm = math::cross(load.ground_m, load.push_n);
  const float hip_m = chain.link[model::has(leg, 0) ? 0 : 1].position_m.z();
  const float leg_m = math::max(hip_m - chain.link[kLegJoints - 1].position_m.z(), 1e-3F);
  for (int k = kLegJoints - 1; k >= 0; --k) {
    const JointParams& joint = model::joint_of(params, leg, k);
    const Pose& link = chain.link[k];
    const Vec3 com_m = math::apply(link, math::to_vec(joint.com_link_m));
    const float down = math::clamp((hip_m - com_m.z()) / leg_m, 0.0F, 1.0F);
    const Vec3 weight_n =
        -joint.mass_kg * (load.body_lift_m_s2 + down * (load.foot_lift_m_s2 - load.body_lift_m_s2));
    force_n += weight_n;
    moment_nm += math::cross(com_m, weight_n);
    const Vec3 axis = kinematics::joint_axis(joint, link.rotation);
    const float servo_nm = -axis.dot(moment_nm - math::cross(link.position_m, force_n));
    const float taken =
        taken_nm(tuning, joint, servo_nm, motion.rate_rad_s[k], motion.accel_rad_s2[k]);
    leg_rad[k] += joint.compliance_rad_nm * (servo_nm + taken);
  }
}

}  // namespace verp::balance
