#include "host/session/asked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace verp::session {
namespace {

constexpr double kLeastShare = 0.5;
constexpr double kStartAndStop_s = 2;  // at least
constexpr double kDegrees = 180 / std::numbers::pi;
// A turn or a way that small is what feet that step in place do anyway.
constexpr double kLeastWay_m = 0.05, kLeastTurn_rad = 0.2;

/// What a walk spends until its steps are as long as asked, and on ending: half of it on its way.
double start_and_stop_s(const GaitTuning& gait, const Command& velocity) {
  const double step_s = 0.5 * gait.cycle_s;
  const double asked_m = step_s * 1e-4 * std::hypot(velocity.vx_tenth_mm_s, velocity.vy_tenth_mm_s);
  const double step_m = std::min<double>(asked_m, gait.max_step_m);
  const double own_s = 2 * gait.start_s + step_s * (1 + step_m / gait.step_change_m);
  return std::max(kStartAndStop_s, own_s);
}

}  // namespace

Way asked_way(const Command& velocity, double walk_s) {
  const sim::Vec2 v_m_s(1e-4 * velocity.vx_tenth_mm_s, 1e-4 * velocity.vy_tenth_mm_s);
  const double turn_rad_s = 1e-3 * velocity.wz_mrad_s;
  Way way{.length_m = v_m_s.norm() * walk_s, .turn_rad = turn_rad_s * walk_s, .point_m = {}};
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(way.turn_rad) / 0.05)));
  for (int i = 0; i <= count; ++i) {
    const double t_s = walk_s * i / count, turned_rad = turn_rad_s * t_s;
    // Mean of the velocity's direction while it turned so far: sin(a)/a ahead, (1-cos(a))/a aside.
    const double ahead = turned_rad != 0 ? std::sin(turned_rad) / turned_rad : 1;
    const double aside = turned_rad != 0 ? (1 - std::cos(turned_rad)) / turned_rad : 0;
    way.point_m.push_back(t_s * sim::Vec2(ahead * v_m_s.x() - aside * v_m_s.y(),
                                          aside * v_m_s.x() + ahead * v_m_s.y()));
  }
  return way;
}

std::string shortfall(const Command& velocity, const sim::WalkMetrics& walked,
                      const GaitTuning& gait) {
  const double judged_s = std::max(0.0, walked.walk_s - start_and_stop_s(gait, velocity));
  const Way way = asked_way(velocity, judged_s);
  // A turn to the other side, or a straight way backwards, covers less than nothing.
  const double turned_rad = std::copysign(1.0, way.turn_rad) * walked.yaw_drift_deg / kDegrees;
  const sim::Vec2 went_m(walked.ahead_m, walked.lateral_drift_m);
  const bool backwards = velocity.wz_mrad_s == 0 && went_m.dot(way.point_m.back()) < 0;
  const double length_m = backwards ? 0 : walked.distance_m;
  if (way.length_m >= kLeastWay_m && length_m < kLeastShare * way.length_m) {
    return fmt::format("went {:.2f} m{}, less than half of what was asked: {:.2f} m in {:g} s",
                       walked.distance_m, backwards ? " the other way" : "",
                       asked_way(velocity, walked.walk_s).length_m, walked.walk_s);
  }
  if (std::abs(way.turn_rad) >= kLeastTurn_rad &&
      turned_rad < kLeastShare * std::abs(way.turn_rad)) {
    return fmt::format(
        "turned by {:.0f} degrees, less than half of what was asked: {:.0f} in {:g} s",
        walked.yaw_drift_deg, kDegrees * asked_way(velocity, walked.walk_s).turn_rad,
        walked.walk_s);
  }
  return "";
}

}  // namespace verp::session
