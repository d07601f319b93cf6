#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"
#include "host/tool/command.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_ending.hpp"

namespace verp::tool {
namespace {

WalkPlan make_plan(const WalkOptions& options) {
  check_board(options);
  WalkPlan plan;
  plan.entity = model::load_robot(model::find_model(options.model), options.bus);
  if (!options.board.empty()) require_serial("verp walk --on", plan.entity);
  plan.params = model::make_params(plan.entity);
  apply_tuning(options, plan.params.tuning);
  plan.velocity = velocity_of(options, options.step_m);
  plan.walk_s = options.walk_s;
  plan.twin.seed = options.seed;
  plan.board = options.board;
  return plan;
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
  return finish_walk(plan, options, files, result, swept);
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
