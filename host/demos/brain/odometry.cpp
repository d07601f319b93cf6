#include "host/demos/brain/odometry.hpp"

namespace verp::brain {

void Odometry::update(const Inputs& inputs, const State& state, const Outputs& outputs) {
  constexpr double kTenth_mrad = 1e-4;
  roll_rad_ = kTenth_mrad * outputs.tilt_tenth_mrad[0];
  pitch_rad_ = kTenth_mrad * outputs.tilt_tenth_mrad[1];
  float angle_rad[kMaxJoints] = {};
  for (int j = 0; j < params_.joint_count; ++j) {
    const JointParams& joint = params_.joint[j];
    if (joint.counts_per_rad == 0.0F) continue;
    const double counts = static_cast<double>(inputs.position_count[j]) - joint.zero_count;
    angle_rad[j] = static_cast<float>(counts / joint.counts_per_rad);
  }
  const math::Mat3 tilt = math::rot_y(math::sincos(static_cast<float>(pitch_rad_))) *
                          math::rot_x(math::sincos(static_cast<float>(roll_rad_)));
  kinematics::all_poses(params_, {tilt, math::Vec3::Zero()}, angle_rad, node_);

  Point sole_m[kFeet];
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params_.leg[side];
    kinematics::LegChain chain;
    chain.link[kLegJoints - 1] = node_[leg.joint[kLegJoints - 1] + 1];
    const math::Vec3 at = kinematics::sole_pose(leg, chain).position_m;
    sole_m[side] = {at.x(), at.y()};
    if (side == carrying_) floor_m_ = at.z();
  }
  const double heading_rad = state.attitude.heading_rad;
  if (outputs.stance < kFeet) carrying_ = outputs.stance;
  if (begun_) {
    const Point before = turned(sole_m_[carrying_], pose_.yaw_rad);
    pose_.at_m = pose_.at_m + before - turned(sole_m[carrying_], heading_rad);
  }
  begun_ = true;
  pose_.yaw_rad = heading_rad;
  for (int side = 0; side < kFeet; ++side) sole_m_[side] = sole_m[side];
}

math::Pose Odometry::above_floor(int node) const {
  math::Pose pose = node_[node];
  pose.position_m.z() -= static_cast<float>(floor_m_);
  return pose;
}

}  // namespace verp::brain
