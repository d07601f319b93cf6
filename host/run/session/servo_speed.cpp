#include "host/run/session/servo_speed.hpp"

#include <fmt/format.h>

#include <cmath>

namespace verp::session {
namespace {

constexpr double kUsualStep_m = 0.04;
// A slow walk, as a share of the square root of gravity times leg: 5 cm/s for legs of 16 cm.
constexpr double kSlowWalk = 0.04;
// Lower lifts than 0.6 of the usual one drag the feet: Open Duck Mini falls at 0.4 of it.
constexpr double kLeastLift = 0.6, kLiftStep = 0.1;

Command ahead(double vx_m_s) {
  Command command;
  command.vx_tenth_mm_s = static_cast<std::int16_t>(std::lround(1e4 * vx_m_s));
  return command;
}

double m_s(const Command& command) {
  return 1e-4 * command.vx_tenth_mm_s;
}

double slow_walk_m_s(const Params& params) {
  const auto leg_m = static_cast<double>(params.leg[0].thigh_m + params.leg[0].shank_m);
  return kSlowWalk * std::sqrt(model::kGravity_m_s2 * leg_m);
}

double most_m_s(const Params& params, double walk_m_s) {
  return m_s(within_servo_speed(params, ahead(walk_m_s)).velocity);
}

double lower_lift_m(Params params, double walk_m_s) {
  const double lift_m = static_cast<double>(params.tuning.gait.lift_m);
  for (double share = 1 - kLiftStep; share > kLeastLift - 1e-6; share -= kLiftStep) {
    params.tuning.gait.lift_m = static_cast<float>(share * lift_m);
    if (most_m_s(params, walk_m_s) >= slow_walk_m_s(params)) return share * lift_m;
  }
  return 0;
}

}  // namespace

ServoSpeed servo_speed(const Params& params) {
  if (params.leg[0].solver == LegSolver::kNone) return {};
  const double walk_m_s = 2 * kUsualStep_m / static_cast<double>(params.tuning.gait.cycle_s);
  ServoSpeed speed{.walk_m_s = walk_m_s, .fastest = fastest_joint(params, ahead(walk_m_s))};
  speed.most_m_s = walk_m_s;
  if (speed.fastest.share <= kMostSpeedShare) return speed;
  speed.most_m_s = most_m_s(params, walk_m_s);
  if (speed.most_m_s == 0) speed.fastest = fastest_joint(params, {});
  if (speed.most_m_s < slow_walk_m_s(params)) speed.lower_lift_m = lower_lift_m(params, walk_m_s);
  return speed;
}

double needed_rad_s(const Fastest& fastest) {
  return fastest.share * fastest.limit_rad_s;
}

double enough_rad_s(const Fastest& fastest) {
  return needed_rad_s(fastest) / kMostSpeedShare;
}

std::string text_of(const ServoSpeed& speed) {
  if (speed.walk_m_s == 0) return "no legs";
  const Fastest& f = speed.fastest;
  const std::string both =
      fmt::format("joint '{}' needs up to {:.3g} rad/s, and its servo turns {:.3g}", f.joint,
                  needed_rad_s(f), f.limit_rad_s);
  if (speed.most_m_s == speed.walk_m_s) {
    return fmt::format("enough for {:.2g} m/s: {}{}", speed.walk_m_s, both,
                       f.share > 1 ? ", which catches up" : "");
  }
  const std::string help =
      (speed.lower_lift_m > 0
           ? fmt::format("gait.lift_m {:.2g} instead makes a slow walk possible; ",
                         speed.lower_lift_m)
           : std::string()) +
      fmt::format("servos of {:.3g} rad/s would do", enough_rad_s(f));
  if (speed.most_m_s == 0)
    return fmt::format("too low to walk: even on the spot {}; {}", both, help);
  return fmt::format("enough for {:.2g} m/s: for {:.2g} m/s {}; {}", speed.most_m_s, speed.walk_m_s,
                     both, help);
}

}  // namespace verp::session
