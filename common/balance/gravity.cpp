#include "common/balance/gravity.hpp"

namespace verp::balance {

Vec3 ground_point(const LegParams& leg, const gait::FootPose& foot, gait::Xy zmp_m) {
  const math::SinCos yaw = math::sincos(foot.on.yaw_rad);
  const gait::Xy in_sole = gait::turned(zmp_m - foot.on.at_m, {-yaw.sin, yaw.cos});
  const gait::Xy inside{math::clamp(in_sole.x, -leg.sole_back_m, leg.sole_front_m),
                        math::clamp(in_sole.y, -leg.sole_right_m, leg.sole_left_m)};
  const gait::Xy at_m = foot.on.at_m + gait::turned(inside, yaw);
  return {at_m.x, at_m.y, foot.height_m};
}

void add_sag(const Params& params, const LegParams& leg, const kinematics::LegChain& chain,
             const LegLoad& load, float* leg_rad) {
  // Force beyond the joint, and its moment about the origin: summed from the sole upwards.
  Vec3 force_n = load.push_n;
  Vec3 moment_nm = math::cross(load.ground_m, load.push_n);
  const float hip_m = chain.link[0].position_m.z();
  const float leg_m = math::max(hip_m - chain.link[kLegJoints - 1].position_m.z(), 1e-3F);
  for (int k = kLegJoints - 1; k >= 0; --k) {
    const JointParams& joint = params.joint[leg.joint[k]];
    const Pose& link = chain.link[k];
    const Vec3 com_m = math::apply(link, math::to_vec(joint.com_link_m));
    const float down = math::clamp((hip_m - com_m.z()) / leg_m, 0.0F, 1.0F);
    const Vec3 weight_n =
        -joint.mass_kg * (load.body_lift_m_s2 + down * (load.foot_lift_m_s2 - load.body_lift_m_s2));
    force_n += weight_n;
    moment_nm += math::cross(com_m, weight_n);
    const Vec3 axis = kinematics::joint_axis(joint, link.rotation);
    const float servo_nm = -axis.dot(moment_nm - math::cross(link.position_m, force_n));
    leg_rad[k] += joint.compliance_rad_nm * servo_nm;
  }
}

}  // namespace verp::balance
