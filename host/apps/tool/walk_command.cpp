#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/commands.hpp"
#include "host/apps/tool/own_controller.hpp"
#include "host/apps/tool/walk_cameras.hpp"
#include "host/apps/tool/walk_ending.hpp"
#include "host/apps/tool/walk_map.hpp"
#include "host/apps/tool/walk_radio.hpp"
#include "host/apps/tool/walk_seeds.hpp"
#include "host/apps/tool/walk_team.hpp"
#include "host/run/scenario/text.hpp"

namespace verp::tool {
namespace {

/// Refuses options for controllers elsewhere if no robot has one: the user expects something else.
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

/// Only the controller itself can record, and this one is at the other end of a link.
void refuse_of_outside(const WalkOptions& options, const WalkPlan& first) {
  const bool wanted =
      !options.record_file.empty() || !options.report_folder.empty() || options.live.on;
  if (first.link.empty() || !wanted) return;
  throw cli::ToolError(
      cli::kBadInput,
      "verp walk: --record, --report and --live are of a robot that this program drives; add "
      "one, or have the controller outside record its own");
}

/// Robots of one world have consecutive seeds; two walks would share some.
void require_one_robot(const WalkOptions& options, const std::vector<WalkPlan>& plans) {
  const char* option = !options.seeds_text.empty() ? "--seeds"
                       : !options.map.kind.empty() ? "--map"
                                                   : nullptr;
  if (option == nullptr || plans.size() == 1) return;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp walk: {} is of walks of one robot; leave the others "
                                   "out",
                                   option));
}

void refuse_many_runs_in_a_scenario(const WalkOptions& options) {
  const char* option = !options.seeds_text.empty()   ? "--seeds"
                       : !options.map.kind.empty()   ? "--map"
                       : !options.sweep_text.empty() ? "--sweep-step"
                                                     : nullptr;
  if (!options.print_scenario || option == nullptr) return;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp walk: a scenario file holds one run, and {} asks for many; leave it out",
                  option));
}

struct Observers {
  Observers(const WalkOptions& options, Walk& walk, RunFiles& files, LiveStream& live,
            cli::Progress& progress)
      : screen(progress, options.command) {
    all = {&files, &screen, &live};
    if (walk.scenario.radio) radio.emplace(walk.scenario);
    if (options.cameras) cameras.emplace(walk, files.first().trace());
    if (walk.scenario.real_time) pace.emplace(walk);
    if (radio) all.push_back(&*radio);
    if (cameras) all.push_back(&*cameras);
    if (pace) all.push_back(&*pace);
  }

  void add_to(Drawn& more, double took_s) const {
    if (radio) {
      more.json["radio"] = radio->json();
      more.text += radio->text();
    }
    if (cameras) {
      more.text += cameras->text(took_s);
      more.json["cameras"] = cameras->json();
    }
    if (!pace) return;
    const app::Deadlines& deadlines = pace->deadlines();
    more.text += fmt::format(
        "  {:<18}{} ticks, {} late, the worst began {:.1f} ms after its time\n", "real time",
        deadlines.ticks, deadlines.missed, 1e-3 * static_cast<double>(deadlines.worst_late_us));
    more.json["deadlines"] = {{"ticks", deadlines.ticks},
                              {"missed", deadlines.missed},
                              {"worst_late_us", deadlines.worst_late_us}};
  }

  RunOnScreen screen;
  std::optional<WalkRadio> radio;
  std::optional<WalkCameras> cameras;
  std::optional<RealTimePace> pace;
  std::vector<session::Observer*> all;
};

int walk_once(WalkOptions options, Walk& walk) {
  const WalkPlan& first = walk.run.plans.front();
  sweep_of(options);  // reports errors before the long run
  refuse_of_outside(options, first);
  check_radio(walk);
  if (options.report_folder.empty() && !options.json && first.link.empty())
    options.report_folder = "report";
  LiveStream live("verp walk", options.live);
  RunFiles files(options, walk, live);
  cli::Progress progress(!options.json);
  Observers observers(options, walk, files, live, progress);
  const Walks walks = walk_together(walk, observers.all, progress);
  const WalkResult& result = walks.results.front();
  const Sweep swept = sweep(first, options, progress);
  progress.clear();
  files.finish_others(walks.results);
  Drawn more = drawn_of(walk);
  more.json["changes"] = touch_json(result);
  more.json.update(team_json(walk, walks, files));
  more.text += touch_text(result) + team_text(walk, walks, files);
  observers.add_to(more, walks.took_s);
  if (observers.cameras && !observers.cameras->failure().empty())
    files.first().lose(observers.cameras->failure());
  live.add_to(more.json);
  more.text += live.text();
  if (result.good()) {
    for (const std::string& line : never_done(first, result)) cli::complain(line);
  }
  const scenario::Robot& robot = walk.scenario.robots[static_cast<std::size_t>(first.number)];
  const int status =
      finish_walk(first, options, robot.orders, files.first(), result, swept, more.json, more.text);
  const std::vector<std::string> failures = failures_of(walk, walks, files);
  for (const std::string& line : failures) cli::complain(line);
  return failures.empty() ? status : std::max(status, int{cli::kRunFailed});
}

int run_walk(WalkOptions options) {
  read_robot_words(options);
  if (options.touch.list) {  // quantities of the nominal robot
    options.vary = false;
    options.touch.pushes.clear();
    options.touch.settings.clear();
  }
  Walk walk = walk_of(options);
  require_outside(options, walk.run.plans);
  refuse_many_runs_in_a_scenario(options);
  if (options.print_scenario) return cli::answer(scenario::print(walk.scenario)), cli::kGood;
  if (options.touch.list) return list_quantities(walk.run, options.json);
  take_controllers(walk.scenario, walk.run.plans, !options.json);
  require_one_robot(options, walk.run.plans);
  if (!options.seeds_text.empty()) {
    if (!options.model_given) options.model = walk.run.plans.front().params.name;
    return walk_seeds(options);
  }
  if (!options.map.kind.empty()) return walk_map(options, walk);
  return walk_once(std::move(options), walk);
}

}  // namespace

cli::Subcommand add_walk(CLI::App& root) {
  CLI::App* app = root.add_subcommand("walk", "Walk in the twin: summary, trace and report");
  auto options = std::make_shared<WalkOptions>();
  declare(*app, *options);
  return {app, [app, options] {
            cli::catch_interrupts();
            options->typed = typed_options(*app);
            options->changed = changed_options(*app);
            options->map.length_given = app->get_option("--for")->count() > 0;
            return run_walk(*options);
          }};
}

}  // namespace verp::tool
