#include <CLI/CLI.hpp>
#include <memory>

#include "host/tool/command.hpp"
#include "host/tool/console.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_ending.hpp"
#include "host/tool/walk_plan.hpp"
#include "host/tool/walk_seeds.hpp"

namespace verp::tool {
namespace {

int run_walk(WalkOptions options) {
  WalkPlan plan = make_plan(options);
  sim::WorldOptions world = world_of(options);
  if (options.touch.list) return list_quantities(plan, world, options.json);
  read_touch(options.touch, plan, world);
  if (!options.seeds_text.empty()) return walk_seeds(options);
  Drawn drawn = draw(options, plan, world);
  sweep_of(options);  // before the long run: a mistake in it is found now
  if (options.report_folder.empty() && !options.json) options.report_folder = "report";
  WalkFiles files(options, plan);
  Progress progress(!options.json);
  const WalkResult result =
      walk(plan, files.trace(), progress, plan.params.name, files.wants_report(), world);
  const Sweep swept = sweep(plan, options, progress);
  progress.clear();
  drawn.json["changes"] = touch_json(result);
  drawn.text += touch_text(result);
  if (result.good()) {
    for (const std::string& line : never_done(plan, result)) complain(line);
  }
  return finish_walk(plan, options, files, result, swept, drawn.json, drawn.text);
}

}  // namespace

Subcommand add_walk(CLI::App& root) {
  CLI::App* app = root.add_subcommand("walk", "Walk in the twin: summary, trace and report");
  auto options = std::make_shared<WalkOptions>();
  declare(*app, *options);
  return {app, [app, options] {
            catch_interrupts();
            options->changed = changed_options(*app);
            return run_walk(*options);
          }};
}

}  // namespace verp::tool
