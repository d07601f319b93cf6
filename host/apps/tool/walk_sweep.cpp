#include "host/apps/tool/walk_sweep.hpp"

#include <fmt/format.h>

#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/walk_scenario.hpp"

namespace verp::tool {
namespace {

using report::SweepWalk;

WalkResult sweep_walk(WalkPlan plan, const sim::WorldOptions& world, double step_m, bool multibody,
                      cli::Progress& progress) {
  plan.asked.reset();
  plan.velocity = scenario::velocity_of(scenario::Ahead{step_m}, plan.params.tuning.gait);
  plan.params.tuning.balance.multibody_enable = multibody ? 1.0f : 0.0f;
  const std::string label =
      fmt::format("step {:g} cm{}", 100 * step_m, multibody ? "" : ", no multibody");
  return walk(plan, nullptr, progress, label, world);
}

SweepWalk entry(const WalkResult& result) {
  using End = SweepWalk::End;
  SweepWalk entry;
  entry.end = result.metrics.fallen     ? End::kFell
              : result.interrupted      ? End::kInterrupted
              : !result.failure.empty() ? End::kFailed
                                        : End::kWalked;
  if (result.longest_step_m > 0) entry.step_m = result.longest_step_m;
  if (entry.end != End::kWalked) return entry;
  entry.speed_m_s = result.metrics.speed_steady_m_s;
  entry.bias_mm = result.metrics.zmp_bias_mean_mm;
  return entry;
}

}  // namespace

Sweep sweep(const WalkPlan& plan, const WalkOptions& options, cli::Progress& progress) {
  Sweep sweep;
  const std::vector<double> steps_m = sweep_of(options);
  if (steps_m.empty()) return sweep;
  const sim::WorldOptions world = scenario::world_of(world_of(options));
  for (const double step_m : steps_m) {
    if (cli::interrupted()) break;
    report::SweepRow row{.step_m = step_m, .with = {}, .without = {}};
    const WalkResult with = sweep_walk(plan, world, step_m, true, progress);
    row.with = entry(with);
    if (!with.failure.empty() && sweep.failure.empty()) {
      sweep.failure = fmt::format("{} in the sweep, at steps of {:g} m", with.failure, step_m);
    }
    if (!cli::interrupted()) row.without = entry(sweep_walk(plan, world, step_m, false, progress));
    sweep.rows.push_back(row);
  }
  sweep.interrupted = cli::interrupted();
  return sweep;
}

}  // namespace verp::tool
