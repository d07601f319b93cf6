#pragma once
#include "host/apps/demos/run.hpp"

namespace verp::demos {

/// Two robots bring a ball into a goal.
Demo ball_demo();

}  // namespace verp::demos
