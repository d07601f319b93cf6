#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/session.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::compare::test {

inline constexpr double kDegree = std::numbers::pi / 180;

inline session::WalkPlan plan_of(double walk_s, std::uint64_t seed = 1) {
  session::WalkPlan plan;
  plan.entity = model::load_robot(model::find_model("generic21"));
  plan.params = model::make_params(plan.entity);
  plan.velocity.vx_tenth_mm_s = 1000;
  plan.walk_s = walk_s;
  plan.twin.seed = seed;
  return plan;
}

inline record::Trace trace_of(const session::WalkPlan& plan, const std::string& name = "a.mcap") {
  record::Trace trace;
  trace.file = name;
  trace.params = plan.params;
  session::Hooks hooks;
  hooks.ticked = [&](const session::Tick& tick) { trace.ticks.push_back(*tick.record); };
  session::walk(plan, hooks);
  return trace;
}

/// Two counts of noise.
inline record::Trace later(const record::Trace& a, double delay_s, double offset_rad) {
  record::Trace b = a;
  b.file = "b.mcap";
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 2);
  for (std::size_t i = 0; i < b.ticks.size(); ++i) {
    const double at = std::clamp(static_cast<double>(i) - delay_s / a.period_s(), 0.0,
                                 static_cast<double>(a.ticks.size() - 1));
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, a.ticks.size() - 1);
    for (std::size_t j = 0; j < a.params.joint_count; ++j) {
      const double from = a.ticks[below].inputs.position_count[j];
      const double to = a.ticks[above].inputs.position_count[j];
      const double count = from + (at - static_cast<double>(below)) * (to - from) +
                           offset_rad * static_cast<double>(a.params.joint[j].counts_per_rad);
      b.ticks[i].inputs.position_count[j] =
          static_cast<std::int32_t>(std::lround(count + noise(random)));
    }
  }
  return b;
}

/// Numbered from that tick.
inline record::Trace begun_later(const record::Trace& a, std::uint32_t ticks) {
  record::Trace b = a;
  b.file = "b.mcap";
  b.ticks.erase(b.ticks.begin(), b.ticks.begin() + ticks);
  for (TickRecord& record : b.ticks) record.inputs.tick -= ticks;
  return b;
}

}  // namespace verp::compare::test
