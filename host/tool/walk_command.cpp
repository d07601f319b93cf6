#include <CLI/CLI.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "host/tool/command.hpp"
#include "host/tool/console.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_ending.hpp"
#include "host/tool/walk_plan.hpp"
#include "host/tool/walk_seeds.hpp"

namespace verp::tool {
namespace {

int run_walk(WalkOptions options) {
  sim::WorldOptions world = world_of(options);
  std::vector<WalkPlan> others = make_plans(options, world);
  WalkPlan plan = others.front();
  others.erase(others.begin());
  if (options.touch.list) return list_quantities(plan, others, world, options.json);
  read_touch(options.touch, plan, others, world);
  if (!options.seeds_text.empty()) return walk_seeds(options);
  Drawn drawn = draw(options, plan, world);
  sweep_of(options);  // before the long run: a mistake in it is found now
  if (options.report_folder.empty() && !options.json) options.report_folder = "report";
  WalkFiles files(options, plan);
  Progress progress(!options.json);
  const Walks walks =
      walk_together(plan, others, files.trace(), progress, files.wants_report(), world);
  const WalkResult& result = walks.result;
  const Sweep swept = sweep(plan, options, progress);
  progress.clear();
  drawn.json["changes"] = touch_json(result);
  drawn.json.update(place_json(walks, world));
  drawn.text += touch_text(result) + place_text(walks, world);
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
            options->model_given = app->get_option("MODEL")->count() > 0;
            return run_walk(*options);
          }};
}

}  // namespace verp::tool
