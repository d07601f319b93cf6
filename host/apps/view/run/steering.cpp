#include "host/apps/view/run/steering.hpp"

#include <algorithm>
#include <cmath>

namespace verp::view {
namespace {

constexpr double kQuarters = 4;

}  // namespace

// Only one of a cycle's steps goes sideways or turns.
Steering::Steering(const Params& params)
    : ahead_m_s_(2.0 * static_cast<double>(params.tuning.gait.max_step_m) /
                 static_cast<double>(params.tuning.gait.cycle_s) / kQuarters),
      left_m_s_(0.5 * ahead_m_s_),
      turn_rad_s_(static_cast<double>(params.tuning.gait.max_turn_rad) /
                  static_cast<double>(params.tuning.gait.cycle_s) / kQuarters) {
  command_.request = Request::kStand;
}

void Steering::nudge(int ahead, int left, int turn) {
  ahead_ = std::clamp(ahead_ + ahead, -kQuarters, kQuarters);
  left_ = std::clamp(left_ + left, -kQuarters, kQuarters);
  turn_ = std::clamp(turn_ + turn, -kQuarters, kQuarters);
  command_.request = Request::kWalk;
  ask();
}

void Steering::lean(double ahead, double left, double turn) {
  if (ahead == 0 && left == 0 && turn == 0) return stop();
  ahead_ = kQuarters * std::clamp(ahead, -1.0, 1.0);
  left_ = kQuarters * std::clamp(left, -1.0, 1.0);
  turn_ = kQuarters * std::clamp(turn, -1.0, 1.0);
  command_.request = Request::kWalk;
  ask();
}

void Steering::stop() {
  ahead_ = left_ = turn_ = 0;
  command_.request = Request::kStand;
  ask();
}

void Steering::relax() {
  stop();
  command_.request = Request::kRelax;
}

void Steering::ask() {
  command_.vx_tenth_mm_s = static_cast<std::int16_t>(std::lround(1e4 * ahead_ * ahead_m_s_));
  command_.vy_tenth_mm_s = static_cast<std::int16_t>(std::lround(1e4 * left_ * left_m_s_));
  command_.wz_mrad_s = static_cast<std::int16_t>(std::lround(1e3 * turn_ * turn_rad_s_));
}

}  // namespace verp::view
