#include "host/apps/view/run/pace.hpp"

#include <algorithm>

namespace verp::view {

int frame_ms(double late_s) {
  constexpr double kLate_s = 0.02;
  constexpr int kSmooth_ms = 33, kFewer_ms = 75;
  return late_s > kLate_s ? kFewer_ms : kSmooth_ms;
}

void Pace::set_speed(double factor, double simulated_s, double wall_s) {
  speed_ = factor;
  begin(simulated_s, wall_s);
}

void Pace::begin(double simulated_s, double wall_s) {
  simulated_s_ = simulated_s;
  wall_s_ = wall_s;
  late_s_ = 0;
  last_.clear();
}

double Pace::wait_s(double simulated_s, double wall_s) {
  if (speed_ <= 0) return 0;
  const double due_s = wall_s_ + (simulated_s - simulated_s_) / speed_;
  late_s_ = std::max(0.0, wall_s - due_s);
  if (wall_s - due_s > kMostLate_s) {
    simulated_s_ = simulated_s;
    wall_s_ = wall_s;
    return 0;
  }
  return due_s > wall_s ? due_s - wall_s : 0;
}

double Pace::factor() const {
  if (last_.size() < 2) return 0;
  const double wall_s = last_.back().second - last_.front().second;
  return wall_s > 0 ? (last_.back().first - last_.front().first) / wall_s : 0;
}

void Pace::ticked(double simulated_s, double wall_s) {
  last_.emplace_back(simulated_s, wall_s);
  while (last_.size() > 2 && wall_s - last_.front().second > 1) last_.pop_front();
}

}  // namespace verp::view
