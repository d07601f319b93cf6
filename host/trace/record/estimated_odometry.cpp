#include <cmath>

#include "host/trace/record/ros_sensors.hpp"

namespace verp::record::ros {
namespace {

Three three(const Vec3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

/// The rotation Rz(yaw) Ry(pitch) Rx(roll).
std::array<double, 4> quaternion_xyzw(double roll_rad, double pitch_rad, double yaw_rad) {
  const double cr = std::cos(roll_rad / 2), sr = std::sin(roll_rad / 2);
  const double cp = std::cos(pitch_rad / 2), sp = std::sin(pitch_rad / 2);
  const double cy = std::cos(yaw_rad / 2), sy = std::sin(yaw_rad / 2);
  return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
          cr * cp * cy + sr * sp * sy};
}

Vec3 rate_rad_s(const ImuParams& imu, const Inputs& inputs, const State& state) {
  Vec3 count;
  for (int i = 0; i < 3; ++i) count(i) = static_cast<float>(inputs.gyro_count[i]);
  Mat3 body_imu;
  for (int i = 0; i < 9; ++i) body_imu(i / 3, i % 3) = imu.body_imu[i];
  return imu.gyro_rad_s_per_count * (body_imu * count) -
         math::to_vec(state.attitude.gyro_bias_rad_s);
}

}  // namespace

std::string estimated_odometry(const Params& params, const Inputs& inputs, const State& state,
                               std::uint64_t time_ns) {
  const balance::EstimatorState& seen = state.estimator;
  const float roll_rad = balance::roll_rad(seen), pitch_rad = balance::pitch_rad(seen);
  const float yaw_rad = state.attitude.heading_rad;
  const Mat3 turned = math::rotation_rpy(roll_rad, pitch_rad, yaw_rad);
  Motion motion;
  motion.pose.position_m = three(math::to_vec(seen.body_m));
  motion.pose.orientation_xyzw = quaternion_xyzw(
      static_cast<double>(roll_rad), static_cast<double>(pitch_rad), static_cast<double>(yaw_rad));
  motion.velocity_m_s = three(turned.transpose() * math::to_vec(seen.body_velocity_m_s));
  motion.rate_rad_s = three(rate_rad_s(params.imu, inputs, state));
  return odometry(motion, frame_of(params, 0), time_ns, "odom");
}

}  // namespace verp::record::ros
