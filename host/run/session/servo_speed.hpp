#pragma once
#include <string>

#include "host/run/session/stride.hpp"

/// Whether a robot's servos turn fast enough to walk: for `verp check`, and for an imported robot's
/// page.
namespace verp::session {

struct ServoSpeed {
  double walk_m_s = 0;  ///< the usual walk, steps of 4 cm; 0: the robot has no legs
  double most_m_s = 0;  ///< what the servos allow; 0: not even steps on the spot
  Fastest fastest;      ///< in the usual walk; in steps on the spot where most_m_s is 0
  /// The highest lift, below the gait's, with which a slow walk fits; 0: none does, or the gait's
  /// own does.
  double lower_lift_m = 0;
};
ServoSpeed servo_speed(const Params& params);

/// The fastest joint's speed in that walk, rad/s.
double needed_rad_s(const Fastest& fastest);
/// The least servo speed for it, rad/s.
double enough_rad_s(const Fastest& fastest);

/// One line, with both speeds; what helps if the servos are too slow.
std::string text_of(const ServoSpeed& speed);

}  // namespace verp::session
