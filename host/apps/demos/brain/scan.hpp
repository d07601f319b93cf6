#pragma once
#include <vector>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

/// A ray that hit something other than the floor.
struct Hit {
  Point at_m;  ///< robot frame at the scan's time
  std::size_t ray = 0;
  double range_m = 0;
};
/// Leaves out rays that may have met the floor, because a walking robot sways.
std::vector<Hit> hits(const About& about, const Scan& scan);

/// A narrow object that stands apart: as wide as a leg, a post or a robot.
struct Thing {
  Point at_m;  ///< centre of the visible side, robot frame
  double wide_m = 0;
};
std::vector<Thing> things(const About& about, const Scan& scan);

/// The laser sees a robot's trunk first; the trunk's centre lies this much further.
inline constexpr double kBehindSurface_m = 0.04;
/// Centre of a robot that appears as `thing`.
Point middle_of(const About& about, const Thing& thing);

}  // namespace verp::brain
