#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/counts.hpp"
#include "common/model/params.hpp"

/// One motor for two joints (URDF's mimic): a follower's angle is its driver's times a ratio, plus
/// an offset. Both come from the driver's counts.
namespace verp::model {

/// The joint whose servo moves `joint`: itself unless it is a follower.
inline int driver_of(const Params& params, int joint) {
  const std::uint8_t id = params.joint[joint].servo_id;
  for (int j = 0; joint >= params.servo_count() && j < params.servo_count(); ++j) {
    if (params.joint[j].servo_id == id) return j;
  }
  return joint;
}

/// The follower's angle when its driver is at `driver_rad`.
inline float followed(const JointParams& driver, const JointParams& follower, float driver_rad) {
  return (driver.zero_count + driver.counts_per_rad * driver_rad - follower.zero_count) /
         follower.counts_per_rad;
}

/// Gives followers their drivers' counts and freshness.
inline void share_counts(const Params& params, Inputs& inputs) {
  for (int j = params.servo_count(); j < params.joint_count; ++j) {
    const int driver = driver_of(params, j);
    inputs.position_count[j] = inputs.position_count[driver];
    inputs.fresh |= (inputs.fresh >> driver & 1U) << j;
  }
}

/// Sets followers' angles from their drivers'.
inline void lead(const Params& params, float* angle_rad) {
  for (int j = params.servo_count(); j < params.joint_count; ++j) {
    const int driver = driver_of(params, j);
    angle_rad[j] = followed(params.joint[driver], params.joint[j], angle_rad[driver]);
  }
}

/// Adds followers' corrections (sag, gravity) to their drivers' angles.
inline void share_corrections(const Params& params, const float* plain_rad, float* angle_rad) {
  for (int j = params.servo_count(); j < params.joint_count; ++j) {
    const int driver = driver_of(params, j);
    angle_rad[driver] += (angle_rad[j] - plain_rad[j]) * params.joint[j].counts_per_rad /
                         params.joint[driver].counts_per_rad;
  }
}

}  // namespace verp::model
