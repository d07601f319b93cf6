#pragma once
#include <vector>

#include "host/twin/sim/robot.hpp"

namespace verp::sim {

/// Angles and pose at the start, with what the seed makes of them.
struct Start {
  std::vector<double> joint_rad;  ///< of entity.joints
  Transform body_world;           ///< the root link's frame in the world
};

/// As the options say: standing, or lying on a side; the lowest point just above the ground.
/// Throws std::invalid_argument: no pose was found in which no links meet (Lies::kAny).
Start make_start(const model::Entity& entity, const TwinOptions& options);

}  // namespace verp::sim
