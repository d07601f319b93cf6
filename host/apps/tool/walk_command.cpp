#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/commands.hpp"
#include "host/apps/tool/own_controller.hpp"
#include "host/apps/tool/walk_cameras.hpp"
#include "host/apps/tool/walk_ending.hpp"
#include "host/apps/tool/walk_map.hpp"
#include "host/apps/tool/walk_plan.hpp"
#include "host/apps/tool/walk_radio.hpp"
#include "host/apps/tool/walk_seeds.hpp"
#include "host/apps/tool/walk_team.hpp"

namespace verp::tool {
namespace {

void add_cameras(const WalkCameras& cameras, const Walks& walks, Drawn& drawn, WalkFiles& files) {
  drawn.text += cameras.text(walks.took_s);
  drawn.json["cameras"] = cameras.json();
  if (!cameras.failure().empty()) files.lose(cameras.failure());
}

void add_deadlines(const app::Deadlines& deadlines, Drawn& drawn) {
  drawn.text += fmt::format("  {:<18}{} ticks, {} late, the worst began {:.1f} ms after its time\n",
                            "real time", deadlines.ticks, deadlines.missed,
                            1e-3 * static_cast<double>(deadlines.worst_late_us));
  drawn.json["deadlines"] = {{"ticks", deadlines.ticks},
                             {"missed", deadlines.missed},
                             {"worst_late_us", deadlines.worst_late_us}};
}

/// Said of controllers outside, where there is none: something is not as its user thinks.
void require_outside(const WalkOptions& options, const std::vector<WalkPlan>& plans) {
  const bool outside = std::any_of(plans.begin(), plans.end(),
                                   [](const WalkPlan& plan) { return !plan.link.empty(); });
  if (outside || options.team.of_outside.empty()) return;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp walk: {} is of robots that others drive, and there is none; add "
                  "--robot NAME=ext:LINK, or leave it out",
                  options.team.of_outside));
}

/// What only the controller itself can tell is not to be had from the other end of a link.
void refuse_of_outside(const WalkOptions& options, const WalkPlan& first) {
  const bool wanted =
      !options.record_file.empty() || !options.report_folder.empty() || options.live.on;
  if (first.link.empty() || !wanted) return;
  throw cli::ToolError(
      cli::kBadInput,
      "verp walk: --record, --report and --live are of a robot that this program drives; add "
      "one, or have the controller outside record its own");
}

std::string first_name(const WalkPlan& plan) {
  return plan.name.empty() ? plan.params.name : plan.name;
}

/// Robots of one world have seeds in a row: those of two walks would be the same ones in part, and
/// no share could be told of them.
void require_one_robot(const WalkOptions& options, const std::vector<WalkPlan>& others) {
  const char* option = !options.seeds_text.empty() ? "--seeds"
                       : !options.map.kind.empty() ? "--map"
                                                   : nullptr;
  if (option == nullptr || others.empty()) return;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp walk: {} is of walks of one robot; leave the others "
                                   "out",
                                   option));
}

int run_walk(WalkOptions options) {
  read_robot_words(options);
  sim::WorldOptions world = world_of(options);
  std::vector<WalkPlan> others = make_plans(options, world);
  require_outside(options, others);
  if (!options.touch.list) take_controller(options.controller, others, !options.json);
  WalkPlan plan = others.front();
  others.erase(others.begin());
  if (options.touch.list) return list_quantities(plan, others, world, options.json);
  read_touch(options.touch, plan, others, world);
  require_one_robot(options, others);
  if (!options.seeds_text.empty()) {
    if (!options.model_given) options.model = plan.params.name;
    return walk_seeds(options);
  }
  if (!options.map.kind.empty()) return walk_map(options, plan, world);
  Drawn drawn = draw(options, plan, world);
  for (WalkPlan& other : others) {
    sim::WorldOptions same = world;  // of the floor, the first one's draw holds
    draw(options, other, same);
  }
  sweep_of(options);  // before the long run: a mistake in it is found now
  refuse_of_outside(options, plan);
  check_radio(options, plan, others);
  if (options.report_folder.empty() && !options.json && plan.link.empty())
    options.report_folder = "report";
  options.board = plan.board;
  LiveStream live("verp walk", options.live);
  WalkFiles files(options, plan, live.robot(others.empty() ? "" : first_name(plan)));
  OtherFiles other_files(options, files, others, live);
  std::unique_ptr<WalkCameras> cameras;
  if (options.cameras)
    cameras = std::make_unique<WalkCameras>(options, plan, others, world, files.trace());
  live.wait_for_viewer();
  cli::Progress progress(!options.json);
  const Walks walks =
      walk_together(plan, others, options, world, files, other_files, progress, cameras.get());
  live.finish();
  const WalkResult& result = walks.result;
  const Sweep swept = sweep(plan, options, progress);
  progress.clear();
  other_files.finish(walks);
  drawn.json["changes"] = touch_json(result);
  drawn.json.update(team_json(walks, others, other_files, world));
  drawn.text += touch_text(result) + team_text(walks, others, other_files, world);
  if (cameras) add_cameras(*cameras, walks, drawn, files);
  if (options.real_time) add_deadlines(walks.deadlines, drawn);
  live.add_to(drawn.json);
  drawn.text += live.text();
  if (result.good()) {
    for (const std::string& line : never_done(plan, result)) cli::complain(line);
  }
  const int status = finish_walk(plan, options, files, result, swept, drawn.json, drawn.text);
  const std::vector<std::string> failures = failures_of(walks, other_files);
  for (const std::string& line : failures) cli::complain(line);
  return failures.empty() ? status : std::max(status, int{cli::kRunFailed});
}

}  // namespace

cli::Subcommand add_walk(CLI::App& root) {
  CLI::App* app = root.add_subcommand("walk", "Walk in the twin: summary, trace and report");
  auto options = std::make_shared<WalkOptions>();
  declare(*app, *options);
  return {app, [app, options] {
            cli::catch_interrupts();
            options->changed = changed_options(*app);
            options->map.length_given = app->get_option("--for")->count() > 0;
            return run_walk(*options);
          }};
}

}  // namespace verp::tool
