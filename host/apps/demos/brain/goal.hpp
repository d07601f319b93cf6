#pragma once
#include <memory>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

/// Walks through an unknown place to `goal`, given in the frame of the start pose. The robot maps
/// what its laser sees, localises itself in the map, and replans as it learns.
std::unique_ptr<Brain> make_goal_goer(const About& about, Point goal);

}  // namespace verp::brain
