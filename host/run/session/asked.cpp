#include "host/run/session/asked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/gait/types.hpp"

namespace verp::session {
namespace {

constexpr double kLeastShare = 0.5;
constexpr double kStartAndStop_s = 2;  // at least
constexpr double kDegrees = 180 / std::numbers::pi;
// Feet that step in place make smaller turns and ways by themselves.
constexpr double kLeastWay_m = 0.05, kLeastTurn_rad = 0.2;
constexpr const char* kAsked = "what was asked";
constexpr const char* kOfItsGait = "what its gait goes in that time";

/// Time of the growing and shrinking steps; they cover half their way.
double start_and_stop_s(const GaitTuning& gait, const Command& velocity) {
  const double step_s = 0.5 * gait.cycle_s;
  const double asked_m = step_s * 1e-4 * std::hypot(velocity.vx_tenth_mm_s, velocity.vy_tenth_mm_s);
  const double step_m = std::min<double>(asked_m, gait.max_step_m);
  const double own_s = 2 * gait.start_s + step_s * (1 + step_m / gait.step_change_m);
  return std::max(kStartAndStop_s, own_s);
}

/// A walk's time in whole steps, as the gait divides it (gait::next_step).
struct Steps {
  Steps(const GaitTuning& gait, double walk_s) {
    const double key_s = gait.cycle_s / (2.0 * gait::kKeyPointsPerStep);
    step_s = key_s * gait::kKeyPointsPerStep;
    const double still_s =
        key_s * std::max<double>(gait::kKeyPointsPerStep, std::floor(gait.start_s / key_s));
    count = std::max(0, static_cast<int>(std::lround((walk_s - 2 * still_s) / step_s)));
  }
  double step_s;
  int count;  ///< between the first and last weight shift

  /// Sum of strides towards `asked`, `change` more per step. The last one closes the feet.
  double sum(double asked, double change) const {
    double all = 0;
    for (int i = 1; i <= count; ++i)
      all += std::min(std::abs(asked), change * std::min(i, count - i));
    return std::copysign(all, asked);
  }
};

/// A straight walk backwards counts as zero.
bool went_backwards(const Command& velocity, const sim::WalkMetrics& walked) {
  const sim::Vec2 asked(velocity.vx_tenth_mm_s, velocity.vy_tenth_mm_s);
  return velocity.wz_mrad_s == 0 &&
         sim::Vec2(walked.ahead_m, walked.lateral_drift_m).dot(asked) < 0;
}
double went_m(const Command& velocity, const sim::WalkMetrics& walked) {
  return went_backwards(velocity, walked) ? 0 : walked.distance_m;
}
double turned_rad(const Command& velocity, const sim::WalkMetrics& walked) {
  return std::copysign(1.0, velocity.wz_mrad_s) * walked.yaw_drift_deg / kDegrees;
}

}  // namespace

Way asked_way(const Command& velocity, double walk_s) {
  const sim::Vec2 v_m_s(1e-4 * velocity.vx_tenth_mm_s, 1e-4 * velocity.vy_tenth_mm_s);
  const double turn_rad_s = 1e-3 * velocity.wz_mrad_s;
  Way way{.length_m = v_m_s.norm() * walk_s, .turn_rad = turn_rad_s * walk_s, .point_m = {}};
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(way.turn_rad) / 0.05)));
  for (int i = 0; i <= count; ++i) {
    const double t_s = walk_s * i / count, turned_rad = turn_rad_s * t_s;
    // Mean velocity during the turn: sin(a)/a ahead, (1-cos(a))/a aside.
    const double ahead = turned_rad != 0 ? std::sin(turned_rad) / turned_rad : 1;
    const double aside = turned_rad != 0 ? (1 - std::cos(turned_rad)) / turned_rad : 0;
    way.point_m.push_back(t_s * sim::Vec2(ahead * v_m_s.x() - aside * v_m_s.y(),
                                          aside * v_m_s.x() + ahead * v_m_s.y()));
  }
  return way;
}

Reach within_reach(const Command& velocity, double walk_s, const GaitTuning& gait) {
  constexpr double kTurnChange = 0.25;  // of the longest turn
  const Steps steps(gait, walk_s);
  const double x_m = steps.sum(1e-4 * velocity.vx_tenth_mm_s * steps.step_s, gait.step_change_m);
  const double y_m = steps.sum(1e-4 * velocity.vy_tenth_mm_s * steps.step_s, gait.step_change_m);
  return {std::hypot(x_m, y_m),
          steps.sum(1e-3 * velocity.wz_mrad_s * steps.step_s, kTurnChange * gait.max_turn_rad)};
}

std::string shortfall(const Command& velocity, const sim::WalkMetrics& walked,
                      const GaitTuning& gait) {
  const double judged_s = std::max(0.0, walked.walk_s - start_and_stop_s(gait, velocity));
  const Way judged = asked_way(velocity, judged_s), asked = asked_way(velocity, walked.walk_s);
  const Reach reach = within_reach(velocity, walked.walk_s, gait);
  const double went = went_m(velocity, walked), turned = turned_rad(velocity, walked);
  const auto lacks = [](double had, double due, double least) {
    return std::abs(due) >= least && had < kLeastShare * std::abs(due);
  };
  const bool way = lacks(went, judged.length_m, kLeastWay_m);
  if (way || lacks(went, reach.length_m, kLeastWay_m)) {
    return fmt::format("went {:.2f} m{}, less than half of {}: {:.2f} m in {:.3g} s",
                       walked.distance_m, went_backwards(velocity, walked) ? " the other way" : "",
                       way ? kAsked : kOfItsGait, way ? asked.length_m : reach.length_m,
                       walked.walk_s);
  }
  const bool turn = lacks(turned, judged.turn_rad, kLeastTurn_rad);
  if (turn || lacks(turned, reach.turn_rad, kLeastTurn_rad)) {
    return fmt::format("turned by {:.0f} degrees, less than half of {}: {:.0f} in {:.3g} s",
                       walked.yaw_drift_deg, turn ? kAsked : kOfItsGait,
                       kDegrees * (turn ? asked.turn_rad : reach.turn_rad), walked.walk_s);
  }
  return "";
}

std::string slow_start(const Command& velocity, const sim::WalkMetrics& walked,
                       const GaitTuning& gait) {
  const Reach reach = within_reach(velocity, walked.walk_s, gait);
  const Way asked = asked_way(velocity, walked.walk_s);
  constexpr const char* kWhy = "this gait, whose strides grow and shrink step by step,";
  if (asked.length_m >= kLeastWay_m && walked.distance_m < kLeastShare * asked.length_m) {
    return fmt::format("went {:.2f} m of the {:.2f} m asked: {} goes {:.2f} m in {:.3g} s",
                       walked.distance_m, asked.length_m, kWhy, reach.length_m, walked.walk_s);
  }
  if (std::abs(asked.turn_rad) >= kLeastTurn_rad &&
      turned_rad(velocity, walked) < kLeastShare * std::abs(asked.turn_rad)) {
    return fmt::format(
        "turned by {:.0f} degrees of the {:.0f} asked: {} turns by {:.0f} in {:.3g} s",
        walked.yaw_drift_deg, kDegrees * asked.turn_rad, kWhy, kDegrees * reach.turn_rad,
        walked.walk_s);
  }
  return "";
}

}  // namespace verp::session
