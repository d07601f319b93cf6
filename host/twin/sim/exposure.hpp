#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::sim {

/// Time and all poses of a picture, for drawing it later. A run does not depend on exposures.
struct Exposure {
  std::uint64_t time_us = 0;
  std::vector<std::size_t> cameras;  ///< indices in Entity::cameras
  std::size_t robot = 0;             ///< index of the cameras' robot
  /// Robots in the order in which they joined the world.
  std::vector<std::vector<model::Transform>> link_world;
  std::vector<model::Transform> body_world;  ///< objects that can move
};

/// Opens at whole periods of simulated time, in the step that ends then or first after.
class Shutter {
 public:
  explicit Shutter(double rate_hz) : rate_hz_(rate_hz) {}
  bool opens(std::uint64_t now_us) {
    const double due_s = static_cast<double>(opened_ + 1) / rate_hz_;
    if (now_us < static_cast<std::uint64_t>(std::llround(1e6 * due_s))) return false;
    ++opened_;
    return true;
  }

 private:
  double rate_hz_;
  std::uint64_t opened_ = 0;
};

}  // namespace verp::sim
