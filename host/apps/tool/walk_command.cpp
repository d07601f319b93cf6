#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/commands.hpp"
#include "host/apps/tool/own_controller.hpp"
#include "host/apps/tool/walk_ending.hpp"
#include "host/apps/tool/walk_map.hpp"
#include "host/apps/tool/walk_radio.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/apps/tool/walk_seeds.hpp"
#include "host/apps/tool/walk_team.hpp"
#include "host/run/scenario/text.hpp"
#include "host/run/session/session.hpp"
#include "host/show/camera/recorder.hpp"

namespace verp::tool {
namespace {

/// Pictures in the first robot's trace, by host/show/camera.
class WalkCameras final : public session::Observer {
 public:
  /// Throws ToolError without a camera, a trace or a renderer.
  WalkCameras(Walk& walk, record::TraceWriter* trace);
  ~WalkCameras() override;

  void join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) override;
  void end(session::Session& session) override;

  std::string text(double run_s) const;
  cli::Json json() const;
  /// Why pictures are missing, or empty.
  std::string failure() const;

 private:
  struct Seen;
  std::unique_ptr<Seen> seen_;
};

record::TraceWriter& need_trace(const WalkPlan& plan, record::TraceWriter* trace) {
  if (plan.entity.cameras.empty()) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp walk: --cameras: {} has none; give one of its links in {} a "
                    "<sensor type=\"camera\">",
                    plan.entity.name, plan.entity.file));
  }
  if (trace != nullptr) return *trace;
  throw cli::ToolError(
      cli::kBadInput,
      "verp walk: --cameras: pictures go into a trace, and there is none; give --record");
}

struct WalkCameras::Seen {
  record::TraceWriter& trace;
  std::unique_ptr<camera::Rig> rig = {};
  std::unique_ptr<camera::Recorder> recorder = {};
};

WalkCameras::WalkCameras(Walk& walk, record::TraceWriter* trace)
    : seen_(new Seen{need_trace(walk.run.plans.front(), trace)}) {
  walk.run.plans.front().twin.cameras = true;
  const sim::WorldOptions& world = walk.run.world;
  camera::Stage stage{.robots = {},
                      .world_file = world.scenery == nullptr ? "" : world.scenery->file};
  for (const WalkPlan& plan : walk.run.plans)
    stage.robots.push_back({plan.entity.file, plan.twin.seed});
  const auto pace =
      walk.scenario.real_time ? camera::Rig::Pace::kNeverWaits : camera::Rig::Pace::kEveryPicture;
  try {
    seen_->rig = std::make_unique<camera::Rig>(camera::find_program(), stage, pace);
  } catch (const camera::CameraError& error) {
    throw cli::ToolError(cli::kNoDevice, error.what());
  }
}

WalkCameras::~WalkCameras() = default;

void WalkCameras::join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) {
  if (index != 0) return;
  seen_->recorder =
      std::make_unique<camera::Recorder>(*seen_->rig, plan.entity, plan.params, seen_->trace);
  hooks.exposed = [this](const sim::Exposure& exposure, std::uint64_t stamp_ns) {
    seen_->recorder->exposed(exposure, stamp_ns);
  };
}

void WalkCameras::end(session::Session&) {
  seen_->recorder->finish();
}

std::string WalkCameras::text(double run_s) const {
  const auto pictures =
      static_cast<double>(std::max<std::uint64_t>(1, seen_->recorder->pictures()));
  std::string out =
      fmt::format("  {:<18}{} pictures, {:.1f} ms of a core each, {:.2f} of a core while it walked",
                  "cameras", seen_->recorder->pictures(),
                  1e3 * seen_->rig->processor_s() / pictures, seen_->rig->processor_s() / run_s);
  if (seen_->rig->dropped() > 0)
    out += fmt::format("; {} left out to keep real time", seen_->rig->dropped());
  return out + "\n";
}

std::string WalkCameras::failure() const {
  return seen_->recorder ? seen_->recorder->failure() : "";
}

cli::Json WalkCameras::json() const {
  return {{"pictures", seen_->recorder->pictures()},
          {"dropped", seen_->rig->dropped()},
          {"processor_s", seen_->rig->processor_s()}};
}

/// Refuses options for controllers elsewhere if no robot has one.
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
