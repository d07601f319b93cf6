#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"
#include "host/sim/vary.hpp"
#include "host/tool/command.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_ending.hpp"
#include "host/tool/walk_seeds.hpp"

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

/// What the robot and its world became by --vary.
struct Drawn {
  Json json = Json::object();
  std::string text;
};

Drawn draw(const WalkOptions& options, WalkPlan& plan, sim::WorldOptions& world) {
  Drawn drawn;
  drawn.json["physics_step_ms"] = options.physics_step_ms;
  if (!options.vary) return drawn;
  sim::Varied varied = sim::vary(plan.entity, plan.twin, world);
  plan.entity = std::move(varied.entity);
  plan.twin = varied.twin;
  world = varied.world;
  drawn.text = fmt::format("varied by seed {}:\n", plan.twin.seed);
  for (const auto& [name, value] : varied.drawn) {
    drawn.json["varied"][name] = value;
    drawn.text += fmt::format("  {:<24} {:.4g}\n", name, value);
  }
  return drawn;
}

int run_walk(WalkOptions options) {
  WalkPlan plan = make_plan(options);
  if (!options.seeds_text.empty()) return walk_seeds(options);
  sim::WorldOptions world = world_of(options);
  const Drawn drawn = draw(options, plan, world);
  sweep_of(options);  // before the long run: a mistake in it is found now
  if (options.report_folder.empty() && !options.json) options.report_folder = "report";
  WalkFiles files(options, plan);
  Progress progress(!options.json);
  const WalkResult result =
      walk(plan, files.trace(), progress, plan.params.name, files.wants_report(), world);
  const Sweep swept = sweep(plan, options, progress);
  progress.clear();
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
