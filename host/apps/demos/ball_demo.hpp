#pragma once
#include "host/apps/demos/run.hpp"

namespace verp::demos {

Demo ball_demo();

}  // namespace verp::demos
