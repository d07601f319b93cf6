#pragma once
#include "tests/unit/support/test_robot.hpp"

namespace verp::test {

inline constexpr int kFollower = kJointCount - 1;  ///< the right hip's yaw

/// The left hip yaw's servo turns the right one `ratio` times as far. That joint is last, after the
/// leg that it carries.
inline Params with_coupled_hips(const Params& robot, float ratio) {
  Params params = robot;
  const auto place = [](int joint) {
    return joint == kRightLeg ? kFollower : joint > kRightLeg ? joint - 1 : joint;
  };
  for (int j = 0; j < kJointCount; ++j) {
    JointParams& joint = params.joint[place(j)];
    joint = robot.joint[j];
    const int parent = robot.joint[j].parent;
    joint.parent = static_cast<std::uint8_t>(parent == 0 ? 0 : place(parent - 1) + 1);
  }
  for (int k = 0; k < kLegJoints; ++k) {
    params.leg[1].joint[k] = static_cast<std::uint8_t>(place(kRightLeg + k));
  }
  const JointParams& driver = params.joint[kLeftLeg];
  JointParams& follower = params.joint[kFollower];
  follower.servo_id = driver.servo_id;
  follower.counts_per_rad = driver.counts_per_rad / ratio;
  follower.zero_count = driver.zero_count;
  params.followers = 1;
  return params;
}

}  // namespace verp::test
