#pragma once
#include <string>

#include "host/run/session/stride.hpp"

/// Whether a robot's servos turn fast enough to walk: for `verp check`, and for an imported robot's
/// page.
namespace verp::session {

struct ServoSpeed {
  double walk_m_s = 0;  ///< of the usual walk, steps of 4 cm; 0: no legs
  double most_m_s = 0;  ///< of it, what the servos allow; 0: not even steps on the spot
  Fastest fastest;      ///< in the usual walk; on the spot where they allow nothing
  /// The highest lift, below the gait's, with which a slow walk fits; 0: none does, or the gait's
  /// own does.
  double lower_lift_m = 0;
};
ServoSpeed servo_speed(const Params& params);

/// What the servos of the fastest joint have to turn, rad/s.
double needed_rad_s(const Fastest& fastest);
/// What would be enough for it.
double enough_rad_s(const Fastest& fastest);

/// One line, with both speeds; what helps if the servos are too slow.
std::string text_of(const ServoSpeed& speed);

}  // namespace verp::session
