#include <fmt/format.h>

#include <memory>

#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"
#include "host/tool/command.hpp"
#include "host/tool/console.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_files.hpp"
#include "host/tool/walk_report.hpp"

namespace verp::tool {
namespace {

WalkPlan make_plan(const WalkOptions& options) {
  check_board(options);
  WalkPlan plan;
  plan.entity = model::load_robot(model::find_model(options.model));
  plan.params = model::make_params(plan.entity);
  apply_tuning(options, plan.params.tuning);
  plan.velocity = velocity_of(options, options.step_m);
  plan.walk_s = options.walk_s;
  plan.seed = options.seed;
  plan.board = options.board;
  return plan;
}

/// One walk with the multibody correction on or off.
WalkResult sweep_walk(WalkPlan plan, const WalkOptions& options, double step_m, bool multibody,
                      Progress& progress) {
  plan.velocity = velocity_of(options, step_m);
  plan.params.tuning.balance.multibody_enable = multibody ? 1.0f : 0.0f;
  const std::string label =
      fmt::format("step {:g} cm{}", 100 * step_m, multibody ? "" : ", no multibody");
  return walk(plan, nullptr, progress, label, false);
}

std::vector<report::SweepRow> sweep(const WalkPlan& plan, const WalkOptions& options,
                                    Progress& progress) {
  std::vector<report::SweepRow> rows;
  for (const double step_m : sweep_of(options)) {
    const WalkResult with = sweep_walk(plan, options, step_m, true, progress);
    const WalkResult without = sweep_walk(plan, options, step_m, false, progress);
    if (interrupted()) break;
    rows.push_back({step_m, with.metrics.speed_steady_m_s, with.metrics.zmp_bias_mean_mm,
                    without.metrics.zmp_bias_mean_mm, with.metrics.fallen, without.metrics.fallen});
  }
  return rows;
}

/// Exit status, and on stderr why it is not good.
int ending(const WalkResult& result, const WalkFiles& files) {
  for (const std::string& line : files.lost()) complain(line);
  if (!result.good()) {
    const std::string trace = files.trace_path().string();
    complain("verp walk: " + (result.failure.empty() ? "interrupted" : result.failure) +
             (trace.empty() ? "" : fmt::format("; `verp trace export {}` shows the run", trace)));
  }
  return result.good() && files.lost().empty() ? kGood : kRunFailed;
}

int run_walk(WalkOptions options) {
  const WalkPlan plan = make_plan(options);
  sweep_of(options);  // before the long run: a mistake in it is found now
  if (options.report_folder.empty() && !options.json) options.report_folder = "report";
  WalkFiles files(options, plan);
  Progress progress(!options.json);
  WalkResult result = walk(plan, files.trace(), progress, plan.params.name, files.wants_report());
  const std::vector<report::SweepRow> rows = sweep(plan, options, progress);
  progress.clear();
  result.interrupted = interrupted();  // in the walk or in the sweep
  for (const report::SweepRow& row : rows) {
    if (row.fallen && result.failure.empty()) {
      result.failure = fmt::format("fell in the sweep, at steps of {:g} m", row.step_m);
    }
  }

  files.finish(result, to_report(plan, options, result, rows));
  if (options.json) {
    Json json = to_json(plan, result, rows);
    files.add_to(json);
    print_json(json);
  } else {
    answer(to_text(plan, result, rows) + files.text());
  }
  return ending(result, files);
}

}  // namespace

Subcommand add_walk(CLI::App& root) {
  CLI::App* app = root.add_subcommand("walk", "Walk in the twin: summary, trace and report");
  auto options = std::make_shared<WalkOptions>();
  declare(*app, *options);
  return {app, [options] { return run_walk(*options); }};
}

}  // namespace verp::tool
