#pragma once
#include <string>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

/// Strides that the servos can follow: the planner ignores servo speed, and beyond it joints lag
/// until the robot falls.
namespace verp::session {

/// The fastest joint of a steady walk, as a share of its speed limit.
struct Fastest {
  double share = 0;
  std::string joint;
  double limit_rad_s = 0;
};
Fastest fastest_joint(const Params& params, const Command& velocity);

/// Above 1: a joint that lags briefly catches up. Measured: generic21, steps of 6 to 15 cm in
/// cycles of 0.30 to 0.45 s, seed 1: walks were good up to 1.28, and all fell from 1.34 on.
inline constexpr double kMostSpeedShare = 1.25;

/// The share of its strides that a steady walk keeps: below 1 the planner shortens them, because
/// legs or ZMP would leave their reach. 0: it stops walking.
double kept_stride(const Params& params, const Command& velocity);

/// An order for the longest steps that the tuning admits, straight ahead.
Command longest_order(const Params& params);

/// `velocity` reduced for the servos; `remark`: a reduction, or empty.
struct FeasibleVelocity {
  Command velocity;
  std::string remark;
};
FeasibleVelocity within_servo_speed(const Params& params, const Command& velocity);

}  // namespace verp::session
