#include "host/run/session/fall_story.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace verp::session {

using safety::Mode;

std::string how_it_lies(double up_x, double up_y) {
  if (std::abs(up_y) > std::abs(up_x)) return up_y < 0 ? "on its left side" : "on its right side";
  return up_x < 0 ? "on its front" : "on its back";
}

std::string FallStory::observe(const State& state, const Outputs& outputs) {
  const auto mode = static_cast<Mode>(outputs.mode);
  const Mode before = std::exchange(mode_, mode);
  if (mode == before) return "";
  const auto attempt = [this] {
    return most_ > 0 ? fmt::format("try {} of {}", tries_, most_) : fmt::format("try {}", tries_);
  };
  const auto& up = state.attitude.up_body;
  const std::string lies =
      "lies " + how_it_lies(static_cast<double>(up.x), static_cast<double>(up.y));
  switch (mode) {
    case Mode::kFalling:
      return "falls, limbs in and soft";
    case Mode::kFallen:
      lies_ = true;
      if (before == Mode::kGettingUp) return fmt::format("{}: {} failed", lies, attempt());
      ++falls_;
      return lies;
    case Mode::kGettingUp:
      ++tries_;
      return (std::exchange(lies_, true) ? "" : lies + "; ") + "gets up, " + attempt();
    case Mode::kStanding:
      tries_ = 0;
      lies_ = false;
      if (before != Mode::kGettingUp) return "";
      ++get_ups_;
      return "stands again";
    case Mode::kHolding:
      return before == Mode::kFalling ? "was caught, and rises anew" : "";
    default:
      return "";
  }
}

}  // namespace verp::session
