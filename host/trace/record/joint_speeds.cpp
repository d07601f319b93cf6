#include "host/trace/record/joint_speeds.hpp"

#include "host/trace/record/ros_messages.hpp"

namespace verp::record {

std::span<const double> JointSpeeds::after(const Inputs& inputs) {
  for (std::size_t j = 0; j < params_.joint_count; ++j) {
    const std::uint32_t bit = 1u << j;
    if ((inputs.fresh & bit) == 0) continue;
    const std::int32_t count = inputs.position_count[j];
    const double time_s = 1e-6 * params_.period_us * (inputs.tick - tick_[j]);
    if ((known_ & bit) != 0 && time_s > 0) {
      const JointParams& joint = params_.joint[j];
      rad_s_[j] = (ros::joint_rad(joint, count) - ros::joint_rad(joint, count_[j])) / time_s;
    }
    known_ |= bit;
    tick_[j] = inputs.tick;
    count_[j] = count;
  }
  return {rad_s_.data(), params_.joint_count};
}

}  // namespace verp::record
