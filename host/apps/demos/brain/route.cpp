#include "host/apps/demos/brain/route.hpp"

#include <utility>

namespace verp::brain {
namespace {

constexpr double kAlong_1_s = 0.6, kAside_1_s = 0.4, kTurn_1_s = 0.9, kTurnAside_rad_m_s = 0.9;
constexpr double kMostAhead_m_s = 0.28, kMostBack_m_s = 0.04, kMostAside_m_s = 0.04;
constexpr double kMostTurn_rad_s = 0.45;

Pose after(const Pose& from, const Bend& bend, double way_m) {
  const double turn_rad = bend.bent * way_m;
  const Point by = std::abs(turn_rad) < 1e-9 ? Point{way_m, 0}
                                             : Point{std::sin(turn_rad) / bend.bent,
                                                     (1 - std::cos(turn_rad)) / bend.bent};
  return out_of(from, Pose{by, turn_rad});
}

}  // namespace

Route::Route(const Pose& from, std::vector<Bend> bends) : from_(from), bends_(std::move(bends)) {
  for (const Bend& each : bends_) long_m_ += each.long_m;
}

Pose Route::at(double way_m) const {
  Pose pose = from_;
  if (way_m < 0) return after(pose, {}, way_m);
  for (const Bend& each : bends_) {
    if (way_m < each.long_m) return after(pose, each, way_m);
    pose = after(pose, each, each.long_m);
    way_m -= each.long_m;
  }
  return after(pose, {}, way_m);
}

double Route::bent(double way_m) const {
  if (way_m < 0) return 0;
  for (const Bend& each : bends_) {
    if (way_m < each.long_m) return each.bent;
    way_m -= each.long_m;
  }
  return 0;
}

void steer(const Pose& robot, const Pose& slot, double v_m_s, double w_rad_s, Orders& orders) {
  const Pose off = into(robot, slot);
  const double vx_m_s = v_m_s * std::cos(off.yaw_rad) + kAlong_1_s * off.at_m.x;
  orders.walk = true;
  orders.vx_m_s = std::fmax(-kMostBack_m_s, std::fmin(kMostAhead_m_s, vx_m_s));
  orders.vy_m_s = within(kAside_1_s * off.at_m.y, kMostAside_m_s);
  orders.wz_rad_s =
      within(w_rad_s + kTurn_1_s * off.yaw_rad + kTurnAside_rad_m_s * within(off.at_m.y, 0.3),
             kMostTurn_rad_s);
}

void Walker::walk(const Pose& robot, Orders& orders) {
  constexpr double kAhead_m = 0.15, kStep_m = 0.01;
  double best_m = way_m_;
  for (double m = way_m_; m <= way_m_ + kAhead_m; m += kStep_m) {
    if (distance(route_.at(m).at_m, robot.at_m) < distance(route_.at(best_m).at_m, robot.at_m))
      best_m = m;
  }
  way_m_ = best_m;
  if (over()) return;
  steer(robot, route_.at(way_m_), speed_m_s_, speed_m_s_ * route_.bent(way_m_), orders);
}

}  // namespace verp::brain
