#pragma once
#include <optional>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

/// The largest patch of orange in a picture.
struct Blob {
  double u_px = 0, v_px = 0;  ///< its middle
  double wide_px = 0;         ///< of a disc of as many pixels
  int pixels = 0;
};
std::optional<Blob> orange_blob(const Picture& picture);

/// Where on the floor something stands that a camera has in that pixel and whose middle is so high,
/// in the robot's odometry; none: it is not below the horizon.
std::optional<Point> on_floor(const About& about, const Picture& picture, double u_px, double v_px,
                              double high_m);

}  // namespace verp::brain
