#pragma once
#include "firmware/app/app.hpp"

namespace verp::app {
using Law = Core;

inline Law law_with(const action::Library& actions) {
  return {actions};
}
}  // namespace verp::app
