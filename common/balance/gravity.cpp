#include "common/balance/gravity.hpp"

namespace verp::balance {

Vec3 ground_point(const LegParams& leg, const gait::FootPose& foot, gait::Xy zmp_m) {
  const gait::Xy in_sole = gait::turned(zmp_m - foot.on.at_m, -foot.on.yaw_rad);
  const gait::Xy inside{math::clamp(in_sole.x, -leg.sole_back_m, leg.sole_front_m),
                        math::clamp(in_sole.y, -leg.sole_right_m, leg.sole_left_m)};
  const gait::Xy at_m = foot.on.at_m + gait::turned(inside, foot.on.yaw_rad);
  return {at_m.x, at_m.y, foot.height_m};
}

void add_sag(const Params& params, const LegParams& leg, const kinematics::LegChain& chain,
             const Vec3& ground_m, float carried_n, float* leg_rad) {
  // Vertical forces beyond the joint, and their moments: all a joint axis can feel of them.
  float force_n = carried_n;
  float force_x_nm = carried_n * ground_m.x();
  float force_y_nm = carried_n * ground_m.y();
  for (int k = kLegJoints - 1; k >= 0; --k) {
    const JointParams& joint = params.joint[leg.joint[k]];
    const Pose& link = chain.link[k];
    const Vec3 com_m = math::apply(link, math::to_vec(joint.com_link_m));
    const float weight_n = joint.mass_kg * math::kGravityMS2;
    force_n -= weight_n;
    force_x_nm -= weight_n * com_m.x();
    force_y_nm -= weight_n * com_m.y();
    const Vec3 axis = kinematics::joint_axis(joint, link.rotation);
    const float moment_x_nm = force_y_nm - force_n * link.position_m.y();
    const float moment_y_nm = force_n * link.position_m.x() - force_x_nm;
    const float servo_nm = -(axis.x() * moment_x_nm + axis.y() * moment_y_nm);
    leg_rad[k] += joint.compliance_rad_nm * servo_nm;
  }
}

}  // namespace verp::balance
