#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::sim {

/// When cameras looked, and where everything was at that moment: pictures are made of it later, by
/// whoever draws. Nothing of a run depends on it.
struct Exposure {
  std::uint64_t time_us = 0;         ///< simulated
  std::vector<std::size_t> cameras;  ///< of Entity::cameras
  std::size_t robot = 0;             ///< whose: of the world's robots
  /// Of each robot, in the order in which they came into the world, each of its nodes.
  std::vector<std::vector<model::Transform>> link_world;
  std::vector<model::Transform> body_world;  ///< of what can move in the world
};

/// Opens at whole periods of simulated time, in the physics step that ends there or first after.
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
