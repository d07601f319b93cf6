#pragma once
#include "firmware/app/app.hpp"

namespace verp::app {
using Law = Core;

/// The controller for a robot with these actions.
inline Law law_with(const action::Library& actions) {
  return {actions};
}
}  // namespace verp::app
