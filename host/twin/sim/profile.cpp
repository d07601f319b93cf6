#include "host/twin/sim/profile.hpp"

#include <algorithm>
#include <cmath>

namespace verp::sim {
namespace {

double toward(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

}  // namespace

void Profile::stand(double count, double speed_count_s) {
  count_ = count;
  speed_count_s_ = speed_count_s;
  ongoing_ = false;
}

void Profile::begin(const ServoSetpoint& setpoint, double step_s) {
  goal_count_ = setpoint.goal_count;
  ongoing_ = true;
  const double way = std::abs(goal_count_ - count_);
  const bool timed = setpoint.profile_ms != 0;
  // e-Manual, Profile Acceleration (108): at most half of the time.
  const double accelerate_s =
      1e-3 * std::min(setpoint.accelerate_ms, static_cast<double>(setpoint.profile_ms) / 2);
  top_count_s_ =
      timed ? way / (setpoint.profile_ms * 1e-3 - accelerate_s) : setpoint.profile_count_s;
  accelerate_count_s2_ = !timed             ? setpoint.accelerate_count_s2
                         : accelerate_s > 0 ? top_count_s_ / accelerate_s
                                            : 0;
  const bool curved = top_count_s_ > 0 && accelerate_count_s2_ > 0;
  kind_ = !timed && setpoint.profile_count_s <= 0 ? ProfileKind::kStep
          : !curved                               ? ProfileKind::kRectangular
          : std::sqrt(accelerate_count_s2_ * way) <= top_count_s_ * (1 + 1e-9)
              ? ProfileKind::kTriangular
              : ProfileKind::kTrapezoidal;
  if (timed && curved) speed_count_s_ = 0;  // starts from rest
  if (!straight()) return;
  const double duration_s = std::max(setpoint.profile_ms * 1e-3, step_s);
  line_count_s_ = (goal_count_ - count_) / duration_s;
  if (!timed && kind_ == ProfileKind::kRectangular) {
    line_count_s_ = std::copysign(top_count_s_, line_count_s_);
  }
}

void Profile::advance(double step_s) {
  if (straight()) return advance_straight(step_s);
  if (ongoing_) advance_curved(step_s);
}

void Profile::advance_straight(double step_s) {
  const double move = line_count_s_ * step_s;
  const double remaining = goal_count_ - count_;
  const bool arrives = std::abs(move) >= std::abs(remaining);
  count_ = arrives ? goal_count_ : count_ + move;
  ongoing_ = !arrives;
  speed_count_s_ = ongoing_ ? line_count_s_ : 0;
}

// Limits the speed so that whole steps can still brake: v step / 2 + v^2 / 2a is left.
void Profile::advance_curved(double step_s) {
  const double left = goal_count_ - count_;
  const double most = accelerate_count_s2_ * step_s;
  const double brakes =
      std::sqrt(most * most / 4 + 2 * accelerate_count_s2_ * std::abs(left)) - most / 2;
  speed_count_s_ =
      toward(speed_count_s_, std::copysign(std::min(top_count_s_, brakes), left), most);
  const double move = speed_count_s_ * step_s;
  const bool slow = std::abs(speed_count_s_) <= 2 * most;
  if (std::abs(left) <= std::max(std::abs(move), 1e-3) && (slow || move * left >= 0)) {
    return stand(goal_count_);
  }
  count_ += move;
}

void Profile::follow_speed(double goal_count_s, double accelerate_count_s2, double step_s) {
  speed_count_s_ = accelerate_count_s2 > 0
                       ? toward(speed_count_s_, goal_count_s, accelerate_count_s2 * step_s)
                       : goal_count_s;
  ongoing_ = speed_count_s_ != goal_count_s;
  kind_ = accelerate_count_s2 > 0 ? ProfileKind::kTrapezoidal : ProfileKind::kStep;
}

}  // namespace verp::sim
