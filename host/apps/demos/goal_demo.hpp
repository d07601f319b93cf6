#pragma once
#include "host/apps/demos/run.hpp"

namespace verp::demos {

Demo goal_demo();

}  // namespace verp::demos
