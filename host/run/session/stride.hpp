#pragma once
#include <string>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

/// What strides the legs' servos can follow, found by planning the walk without a robot. The
/// planner itself knows how far a leg reaches and keeps the ZMP in the sole; how fast a servo turns
/// it does not: asked for more, goals run away from joints until the robot falls.
namespace verp::session {

/// The joint of the legs that a steady walk at this velocity turns fastest, as a part of its speed
/// limit.
struct Fastest {
  double share = 0;
  std::string joint;
};
Fastest fastest_joint(const Params& params, const Command& velocity);

/// A joint that lags for a moment catches up. generic21, steps of 6 to 15 cm in cycles of 0.30 to
/// 0.45 s, seed 1: walks were good up to 1.28, and all fell from 1.34 on.
inline constexpr double kMostSpeedShare = 1.25;

/// An order for the longest steps that the robot's tuning admits, straight ahead.
Command longest_order(const Params& params);

/// `velocity`, or as much of it as the servos can follow; `remark` says what was taken, else it is
/// empty.
struct Followed {
  Command velocity;
  std::string remark;
};
Followed within_servo_speed(const Params& params, const Command& velocity);

}  // namespace verp::session
