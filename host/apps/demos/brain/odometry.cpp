#include "host/apps/demos/brain/odometry.hpp"

#include "common/kinematics/forward.hpp"
#include "common/model/counts.hpp"

namespace verp::brain {

void Odometry::update(const Inputs& inputs, const State& state) {
  const balance::Whereabouts told = balance::whereabouts(state.estimator, state.attitude);
  const Xyz& turned = told.roll_pitch_yaw_rad;
  pose_ = {{told.body_m.x, told.body_m.y}, turned.z};
  roll_rad_ = turned.x;
  pitch_rad_ = turned.y;
  float angle_rad[kMaxJoints] = {};
  for (int j = 0; j < params_.joint_count; ++j)
    angle_rad[j] = model::angle_of(params_.joint[j], inputs.position_count[j]);
  const math::Mat3 tilt = math::rot_y(math::sincos(turned.y)) * math::rot_x(math::sincos(turned.x));
  kinematics::all_poses(params_, {tilt, {0, 0, told.body_m.z}}, angle_rad, node_);
}

}  // namespace verp::brain
