#pragma once
#include <vector>

#include "host/apps/demos/run.hpp"
#include "host/robot/model/world.hpp"

namespace verp::demos {

/// What never moves and is higher than a sole is thick, from above.
std::vector<Outline> outlines_of(const model::World& world);

}  // namespace verp::demos
