#pragma once
#include "controller.hpp"
#include "firmware/law/own_law.hpp"

namespace verp::app {
using Law = OwnLaw<::Controller>;

/// A user's controller ignores the actions.
inline Law law_with(const action::Library&) {
  return {};
}
}  // namespace verp::app
