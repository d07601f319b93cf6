#pragma once
#include "firmware/app/app.hpp"

namespace verp::app {
using Law = Core;

/// What decides a tick of a robot that has these actions.
inline Law law_with(const action::Library& actions) {
  return {actions};
}
}  // namespace verp::app
