#pragma once
#include "host/apps/demos/run.hpp"

namespace verp::demos {

/// One robot leads, the others follow.
Demo follow_demo();
/// A column, two abreast, walks and wheels.
Demo column_demo();

}  // namespace verp::demos
