#pragma once
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::control {

/// Lets another controller (a user's, a policy) move the joints of a robot that step() watches.
/// `core` is what step() gave in this tick, `sent` what the robot got in the previous one. `asked`
/// holds the other controller's outputs, and on return what the robot gets.
///
/// Torque is the core's, less what the other controller takes away. Goals are the other's while the
/// robot stands or walks. While a device is silent they are those sent before. Else they are the
/// core's. No joint with torque moves faster than its velocity limit allows. Mode, faults and the
/// rest are the core's.
///
/// A goal more than kGoalSlack_rad outside its joint's range is refused, and so is that of a NaN:
/// the joint keeps its goal, or stays limp. Returns the first such joint, or kMaxJoints.
int guard(const Params& params, const Inputs& inputs, const Outputs& sent, const Outputs& core,
          Outputs& asked);

/// As much as the core's own goals exceed a joint's range against sag.
inline constexpr float kGoalSlack_rad = 0.1F;

}  // namespace verp::control
