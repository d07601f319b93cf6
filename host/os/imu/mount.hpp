#pragma once
#include <array>
#include <string>

namespace verp::imu {

/// How a chip is mounted, from what its accelerometer felt at rest: with the robot upright, and
/// tilted forward.
struct Mount {
  std::string words;     ///< "mount=-y:x:z"; empty: the poses do not tell
  double askew_rad = 0;  ///< of that to what was felt
};
Mount find_mount(const std::array<double, 3>& upright, const std::array<double, 3>& forward);

}  // namespace verp::imu
