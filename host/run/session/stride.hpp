#pragma once
#include <string>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

/// Finds the strides that the legs' servos can follow, by planning the walk without a robot. The
/// planner knows the legs' reach and keeps the ZMP in the sole, but ignores servo speed. Beyond
/// that speed, joints fall behind their goals until the robot falls.
namespace verp::session {

/// The fastest leg joint of a steady walk at this velocity, as a share of its speed limit.
struct Fastest {
  double share = 0;
  std::string joint;
};
Fastest fastest_joint(const Params& params, const Command& velocity);

/// Above 1, because a joint that lags briefly catches up. Measured: generic21, steps of 6 to 15 cm
/// in cycles of 0.30 to 0.45 s, seed 1: walks were good up to 1.28, and all fell from 1.34 on.
inline constexpr double kMostSpeedShare = 1.25;

/// An order for the longest steps that the tuning admits, straight ahead.
Command longest_order(const Params& params);

/// `velocity`, reduced to what the servos can follow; `remark` reports a reduction, else it is
/// empty.
struct FeasibleVelocity {
  Command velocity;
  std::string remark;
};
FeasibleVelocity within_servo_speed(const Params& params, const Command& velocity);

}  // namespace verp::session
