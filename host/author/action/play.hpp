#pragma once
#include "host/run/session/session.hpp"

namespace verp::action {

struct PlayedAction {
  session::WalkResult run;
  double action_s = 0;  ///< stand to stand
  double asked_s = 0;   ///< simulated time of the request
  /// The way since the request, in the heading then: x ahead, y left.
  sim::Vec2 went_m = sim::Vec2::Zero();
  double turned_rad = 0;  ///< to the left
};

/// Plays action `number` on the twin, with the caller's `hooks`.
PlayedAction play(session::WalkPlan plan, int number, session::Hooks hooks,
                  session::Options options);

}  // namespace verp::action
