#pragma once
#include "controller.hpp"
#include "firmware/law/own_law.hpp"

namespace verp::app {
using Law = OwnLaw<::Controller>;

/// It plays what it likes: the robot's actions are the core's.
inline Law law_with(const action::Library&) {
  return {};
}
}  // namespace verp::app
