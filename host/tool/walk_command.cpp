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

/// Why the run is not good; the trace is of the first walk, not of the sweep. Empty: it is good.
std::string reason(const WalkResult& result, const Sweep& swept, const std::string& trace) {
  if (!result.good()) {
    return (result.failure.empty() ? "interrupted" : result.failure) +
           (trace.empty() ? "" : fmt::format("; `verp trace export {}` shows the run", trace));
  }
  if (!swept.failure.empty())
    return swept.failure + "; walk it with --step and --record to see why";
  return swept.interrupted ? "interrupted in the sweep; rows up to there are kept" : "";
}

/// Exit status, and on stderr why it is not good.
int ending(const std::string& reason, const WalkFiles& files) {
  for (const std::string& line : files.lost()) complain(line);
  if (!reason.empty()) complain("verp walk: " + reason);
  return reason.empty() && files.lost().empty() ? kGood : kRunFailed;
}

int run_walk(WalkOptions options) {
  const WalkPlan plan = make_plan(options);
  sweep_of(options);  // before the long run: a mistake in it is found now
  if (options.report_folder.empty() && !options.json) options.report_folder = "report";
  WalkFiles files(options, plan);
  Progress progress(!options.json);
  const WalkResult result =
      walk(plan, files.trace(), progress, plan.params.name, files.wants_report());
  const Sweep swept = sweep(plan, options, progress);
  progress.clear();

  files.finish(result, to_report(plan, options, result, swept));
  if (options.json) {
    Json json = to_json(plan, result, swept);
    files.add_to(json);
    print_json(json);
  } else {
    answer(to_text(plan, result, swept) + files.text());
  }
  return ending(reason(result, swept, files.trace_path().string()), files);
}

}  // namespace

Subcommand add_walk(CLI::App& root) {
  CLI::App* app = root.add_subcommand("walk", "Walk in the twin: summary, trace and report");
  auto options = std::make_shared<WalkOptions>();
  declare(*app, *options);
  return {app, [options] {
            catch_interrupts();
            return run_walk(*options);
          }};
}

}  // namespace verp::tool
