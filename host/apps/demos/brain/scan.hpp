#pragma once
#include <vector>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

/// A ray that hit something that is not the floor.
struct Hit {
  Point at_m;  ///< in the frame of the robot at the scan's time
  std::size_t ray = 0;
  double range_m = 0;
};
/// A robot that walks sways: rays that may have met the floor are left out.
std::vector<Hit> hits(const About& about, const Scan& scan);

/// Something narrow that stands apart from all else: a leg's, a post's or a robot's width.
struct Thing {
  Point at_m;  ///< its middle, on the side that the laser sees, in the robot's frame
  double wide_m = 0;
};
std::vector<Thing> things(const About& about, const Scan& scan);

/// Of a robot's laser the trunk is the nearest surface of what it sees; its middle is so much
/// further.
inline constexpr double kBehindSurface_m = 0.04;
/// Where the middle of a robot is that looks like this.
Point middle_of(const About& about, const Thing& thing);

}  // namespace verp::brain
