#pragma once
#include <vector>

#include "host/twin/sim/robot.hpp"

namespace verp::sim {

/// Angles and pose at the start, including the seed's variation.
struct Start {
  std::vector<double> joint_rad;
  Transform body_world;  ///< the root link's frame
};

/// Standing or lying, the lowest point just above the ground. Throws std::invalid_argument if all
/// poses intersect (Lies::kAny).
Start make_start(const model::Entity& entity, const TwinOptions& options);

}  // namespace verp::sim
