#include "host/study/tune/trial.hpp"

#include <algorithm>
#include <cmath>

#include "host/run/session/session.hpp"
#include "host/twin/sim/vary.hpp"

namespace verp::tune {

Command ahead(double speed_m_s) {
  Command command;
  command.vx_tenth_mm_s = static_cast<std::int16_t>(std::lround(1e4 * speed_m_s));
  return command;
}

session::WalkResult try_walk(session::WalkPlan plan, const sim::WorldOptions& world,
                             const Trial& trial, const std::function<bool()>& interrupted) {
  plan.twin.seed = trial.seed;
  plan.walk_s = trial.walk_s;
  session::Options options{.world = world, .interrupted = interrupted};
  if (trial.varied) {
    sim::Varied varied = sim::vary(plan.entity, plan.twin, world);
    plan.entity = std::move(varied.entity);
    plan.twin = varied.twin;
    options.world = varied.world;
  }
  return session::walk(plan, {}, std::move(options));
}

double cost_of(const session::WalkResult& result, double walk_s, double speed_m_s) {
  constexpr double kFell = 200, kNoGait = 100, kOfSpeed = 100, kFreeShare = 0.03, kOfDegree = 0.3;
  constexpr double kNoBias_mm = 50;
  const sim::WalkMetrics& m = result.metrics;
  if (!result.good()) {
    return kFell + kNoGait * (1 - std::clamp(m.walk_s / walk_s, 0.0, 1.0));
  }
  const double speed = m.speed_steady_m_s.value_or(m.speed_mean_m_s.value_or(0));
  const double off = std::abs(speed / speed_m_s - 1);
  return m.zmp_bias_mean_mm.value_or(kNoBias_mm) + kOfSpeed * std::max(0.0, off - kFreeShare) +
         kOfDegree * std::abs(m.yaw_drift_deg);
}

}  // namespace verp::tune
