#pragma once
#include <memory>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

/// Goes to a point that is given as seen from where it stands at the start, through a place of
/// which it knows nothing: it makes a map of what its laser sees, finds itself in it, and plans its
/// way anew as it learns.
std::unique_ptr<Brain> make_goal_goer(const About& about, Point goal);

}  // namespace verp::brain
