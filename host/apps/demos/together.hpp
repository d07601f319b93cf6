#pragma once
#include "host/apps/demos/run.hpp"

namespace verp::demos {

Demo follow_demo();
Demo column_demo();

}  // namespace verp::demos
