#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/delay.hpp"
#include "host/twin/sim/exposure.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::sim {

/// When a robot's cameras look, each at its own rate, and what they then had before them.
class Shutters {
 public:
  /// `wanted`: somebody draws; else none ever opens.
  Shutters(const model::Entity& entity, bool wanted);

  /// After each step. Cameras that look in the same one and are as late as each other share an
  /// exposure.
  void sample(const World& world, const Actor& robot);
  /// Those whose pictures could be had since they were last asked for; where nobody asks the oldest
  /// go.
  std::vector<Exposure> take() { return std::exchange(exposures_, {}); }

 private:
  static Exposure expose(const World& world, const Actor& robot);

  const model::Entity& entity_;
  std::vector<Shutter> shutter_;  ///< of each camera
  std::vector<Delay<Exposure>> developing_;
  std::vector<Exposure> exposures_;
};

}  // namespace verp::sim
