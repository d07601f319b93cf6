#pragma once
#include <vector>

#include "host/apps/demos/run.hpp"
#include "host/robot/model/world.hpp"

namespace verp::demos {

/// Outlines, from above, of static objects that reach above 3 cm, a sole's thickness.
std::vector<Outline> outlines_of(const model::World& world);

}  // namespace verp::demos
