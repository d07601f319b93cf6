#include "host/apps/tool/robot/run_ending.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/safety/machine.hpp"
#include "host/run/session/fall_story.hpp"

namespace verp::tool {
namespace {

constexpr float kLies_up = 0.54F;  // cosine of 1 rad, where the twin counts a fall
constexpr double kLeans_rad = 0.35;

}  // namespace

void RunEnding::observe(const State& state, const Outputs& outputs, double period_s) {
  blind_ = (outputs.faults & safety::kFaultImuSilent) != 0;
  up_ = state.attitude.up_body;
  const bool lay = lies_;
  lies_ = up_.z < kLies_up;
  if (outputs.torque_enable != 0) {
    was_upright_ = !lies_;
    limp_s_ = 0;
    return;
  }
  limp_s_ += period_s;
  if (lies_ && !lay) fell_s_ = limp_s_;
}

std::string RunEnding::words() const {
  if (blind_) return "not known: the IMU is silent";
  if (lies_) {
    return "lies " + session::how_it_lies(static_cast<double>(up_.x), static_cast<double>(up_.y));
  }
  const double tilt_rad = std::acos(std::clamp(static_cast<double>(up_.z), -1.0, 1.0));
  if (tilt_rad < kLeans_rad) return "is upright";
  return fmt::format("leans by {:.0f} degrees", 180 / std::numbers::pi * tilt_rad);
}

}  // namespace verp::tool
