#include "common/gait/coupled_hips.hpp"

#include "common/model/coupling.hpp"

namespace verp::gait {

int coupled_hip(const Params& params) {
  if (params.followers == 0 || params.leg[kLeft].solver == LegSolver::kNone) return kBoth;
  for (const std::uint8_t side : {kLeft, kRight}) {
    const int own = params.leg[side].joint[0], other = params.leg[1 - side].joint[0];
    if (own == kNoJoint || other == kNoJoint) continue;
    if (own >= params.servo_count() && model::driver_of(params, own) == other) return side;
  }
  return kBoth;
}

void turn_to_hips(const Params& params, const float (&previous_rad)[kFeet][kLegJoints],
                  Posture& posture) {
  constexpr float kMost_rad = 0.3F;
  const int side = coupled_hip(params);
  if (side == kBoth) return;
  float yaw_rad[kFeet];
  for (int foot = 0; foot < kFeet; ++foot) {
    yaw_rad[foot] = kinematics::solve_leg(params, params.leg[foot], sole_in_body(posture, foot),
                                          previous_rad[foot])
                        .angle_rad[0];
  }
  const JointParams& follower = params.joint[params.leg[side].joint[0]];
  const JointParams& driver = params.joint[params.leg[1 - side].joint[0]];
  const float off_rad = yaw_rad[side] - model::followed(driver, follower, yaw_rad[1 - side]);
  // With the sole fixed, a tilted hip axis turns by the body's turn over its vertical part.
  const float ratio = driver.counts_per_rad / follower.counts_per_rad;
  const float apart = driver.axis.z - ratio * follower.axis.z;
  if (!(math::abs(apart) > 0.1F)) return;
  const float turn_rad =
      math::clamp(off_rad * driver.axis.z * follower.axis.z / apart, -kMost_rad, kMost_rad);
  posture.body.rotation = math::rot_z(turn_rad) * posture.body.rotation;
}

}  // namespace verp::gait
