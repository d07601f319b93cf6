#pragma once
#include "host/apps/demos/run.hpp"

namespace verp::demos {

/// One finds its way through rooms that it does not know.
Demo goal_demo();

}  // namespace verp::demos
