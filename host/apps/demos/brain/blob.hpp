#pragma once
#include <optional>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

/// The largest orange patch in a picture.
struct Blob {
  double u_px = 0, v_px = 0;  ///< centre
  double wide_px = 0;         ///< diameter of a disc of equal area
  int pixels = 0;
};
std::optional<Blob> orange_blob(const Picture& picture);

/// Point on the floor, in the robot's odometry frame, below an object whose centre is `high_m`
/// above the floor and at pixel (u, v). Empty at or above the horizon.
std::optional<Point> on_floor(const About& about, const Picture& picture, double u_px, double v_px,
                              double high_m);

}  // namespace verp::brain
