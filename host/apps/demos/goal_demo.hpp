#pragma once
#include "host/apps/demos/run.hpp"

namespace verp::demos {

/// One robot finds its way through unknown rooms.
Demo goal_demo();

}  // namespace verp::demos
