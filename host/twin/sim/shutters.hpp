#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/delay.hpp"
#include "host/twin/sim/exposure.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::sim {

class Shutters {
 public:
  /// Not `wanted`: no shutter opens.
  Shutters(const model::Entity& entity, bool wanted);

  /// Call after each step; cameras with equal step and latency share an exposure.
  void sample(const World& world, const Actor& robot);
  /// Exposures whose pictures became available since the last call; the oldest are dropped if
  /// nobody takes them.
  std::vector<Exposure> take() { return std::exchange(exposures_, {}); }

 private:
  static Exposure expose(const World& world, const Actor& robot);

  const model::Entity& entity_;
  std::vector<Shutter> shutter_;
  std::vector<Delay<Exposure>> developing_;
  std::vector<Exposure> exposures_;
};

}  // namespace verp::sim
