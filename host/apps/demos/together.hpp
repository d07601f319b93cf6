#pragma once
#include "host/apps/demos/run.hpp"

namespace verp::demos {

/// One leads, the others follow.
Demo follow_demo();
/// A column two abreast, which walks and wheels.
Demo column_demo();

}  // namespace verp::demos
