#include "host/twin/sim/laser.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace verp::sim {

LaserModel::LaserModel(const model::LaserSensor& sensor, std::size_t index, int owner, bool noise,
                       Random random)
    : sensor_(sensor),
      owner_(owner),
      noise_(noise),
      random_(random),
      shutter_(sensor.rate_hz),
      delay_(sensor.latency_s) {
  scan_.laser = index;
  bias_m_ = sensor.noise_mean_m;
}

bool LaserModel::sample(const World& world, const Transform& link) {
  if (shutter_.opens(world.now_us())) {
    Scan taken{.time_us = world.now_us(), .laser = scan_.laser, .range_m = {}};
    const Transform sensor = link * sensor_.pose;
    for (int i = 0; i < sensor_.samples; ++i)
      taken.range_m.push_back(measure(world, sensor, sensor_.angle_rad(i)));
    delay_.put(world.now_us(), std::move(taken));
  }
  auto arrived = delay_.take(world.now_us());
  if (arrived) scan_ = std::move(*arrived);
  return arrived.has_value();
}

/// Draws noise even without a hit, so that one ray's obstacle does not change the others.
float LaserModel::measure(const World& world, const Transform& sensor, double angle_rad) {
  const double noise_m = noise_ ? bias_m_ + sensor_.noise_stddev_m * random_.normal() : 0;
  const Vec3 direction = sensor.linear() * Vec3(std::cos(angle_rad), std::sin(angle_rad), 0);
  const auto hit_m = world.ray_m(sensor.translation(), direction, sensor_.max_m,
                                 {.owner = owner_, .node = sensor_.node});
  if (!hit_m || *hit_m < sensor_.min_m) return std::numeric_limits<float>::infinity();
  double range_m = *hit_m + noise_m;
  if (sensor_.resolution_m > 0)
    range_m = sensor_.resolution_m * std::round(range_m / sensor_.resolution_m);
  return static_cast<float>(range_m);
}

}  // namespace verp::sim
