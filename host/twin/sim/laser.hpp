#pragma once
#include <cstdint>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/delay.hpp"
#include "host/twin/sim/exposure.hpp"
#include "host/twin/sim/random.hpp"
#include "host/twin/sim/world.hpp"

/// One ray, or many in a plane, traced by ODE.
namespace verp::sim {

struct Scan {
  std::uint64_t time_us = 0;
  std::size_t laser = 0;       ///< index in Entity::lasers
  std::vector<float> range_m;  ///< in order of angle; inf: nothing in range
};

class LaserModel {
 public:
  /// Rays pass through the sensor's own link.
  LaserModel(const model::LaserSensor& sensor, std::size_t index, int owner, bool noise,
             Random random);

  /// `link`: its link's pose in the world. Scans are due at whole periods of simulated time, in the
  /// physics step that ends then or first after. True: scan() is new, taken one latency ago.
  bool sample(const World& world, const Transform& link);
  const Scan& scan() const { return scan_; }

 private:
  float measure(const World& world, const Transform& sensor, double angle_rad);

  const model::LaserSensor sensor_;
  const int owner_;
  const bool noise_;
  Random random_;
  double bias_m_ = 0;
  Shutter shutter_;
  Delay<Scan> delay_;
  Scan scan_;
};

}  // namespace verp::sim
