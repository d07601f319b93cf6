#pragma once
#include <vector>

#include "host/twin/sim/robot.hpp"

namespace verp::sim {

/// Angles and pose at the start, including the seed's variation.
struct Start {
  std::vector<double> joint_rad;
  Transform body_world;  ///< the root link's frame in the world
};

/// Start pose of the options: standing, or lying on a side, the lowest point just above the ground.
/// Throws std::invalid_argument if it finds no pose without intersecting links (Lies::kAny).
Start make_start(const model::Entity& entity, const TwinOptions& options);

}  // namespace verp::sim
