#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/real_time.hpp"
#include "host/apps/cli/typed_lines.hpp"
#include "host/apps/tool/bit_rate.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/walk_ending.hpp"
#include "host/apps/tool/walk_report.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/apps/tool/walk_touch.hpp"
#include "host/author/action/get_up.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/os/link/latency.hpp"
#include "host/run/session/remote_controller.hpp"
#include "host/twin/bus/link_fit.hpp"
#include "host/twin/imu/imu_server.hpp"

namespace verp::tool {
namespace {

struct HilResult : session::RemoteResult {
  WalkResult walk;

  double ticks_per_s() const {
    return walk.wall_s > 0 ? static_cast<double>(walk.ticks) / walk.wall_s : 0;
  }
};

/// "u" and Enter set the robot on its feet.
class Keyboard final : public session::Observer {
 public:
  explicit Keyboard(session::RemoteController*& served) : served_(served) {}
  void tick(std::size_t, session::Robot&) override {
    if (lines_.next() == "u") served_->set_upright();
  }

 private:
  session::RemoteController*& served_;
  cli::TypedLines lines_;
};

/// Serves the twin to a controller at the end of a link (session::RemoteController) until the
/// controller or the walk ends. Throws what opening a link throws.
HilResult serve_controller(const scenario::Expanded& run, session::ServeOptions options,
                           cli::Progress& progress, std::vector<session::Observer*> observers) {
  const WalkPlan& plan = run.plans.front();
  const auto say = [&progress](const std::string& line) {
    progress.clear();
    cli::complain("verp hil: " + line);
  };
  options.told = say;
  options.check = [&plan](const link::CanInterface& interface) {
    check_bit_rate("verp hil", interface, plan.params);
  };
  options.real_time_begins = [say] {
    const cli::RealTime got = cli::become_real_time();
    if (!got.advice.empty()) say(got.advice);
  };
  options.cannot_keep_up = cli::leave_real_time;
  session::Session session({.world = run.world, .interrupted = cli::interrupted});
  session::RemoteController* served = nullptr;
  RunOnScreen screen(progress, "verp hil");
  Keyboard keyboard(served);
  observers.insert(observers.end(), {&screen, &keyboard});
  std::vector<WalkResult> results =
      session::run(session, {plan}, observers, [&](session::Robot& robot) {
        auto made = session::make_served(robot, options);
        served = made.get();
        return made;
      });
  progress.clear();
  if (!session.diverged().empty()) throw cli::ToolError(cli::kRunFailed, session.diverged());
  return {served->result(), std::move(results.front())};
}

struct HilWords {
  WalkOptions walk;
  session::ServeOptions hil;
  std::string imu_link;  ///< empty: none
  bool lockstep = false, real_time = false;
};

/// `gives_orders`: this program does; otherwise the controller has its own actions.
Walk walk_of(const WalkOptions& options, bool gives_orders) {
  const sim::WorldOptions world = scenario::world_of(world_of(options));
  Walk walk{.scenario = scenario_of(options, world), .run = {}};
  walk.run = expand(options, walk.scenario, world);
  session::WalkPlan& plan = walk.run.plans.front();
  if (gives_orders && plan.get_ups > 0) action::take_get_up_actions(plan);
  return walk;
}

void check(HilWords& words, const Params& params) {
  if (words.real_time && !words.hil.operator_link.empty()) {
    throw cli::ToolError(
        cli::kBadInput,
        "verp hil: --operator gives orders tick by tick, which takes lockstep; leave "
        "out --realtime or --operator");
  }
  words.hil.pace = words.lockstep    ? session::Pace::kLockstep
                   : words.real_time ? session::Pace::kRealTime
                                     : session::Pace::kAuto;
  const link::Endpoint endpoint = link::parse_endpoint(words.hil.link);
  require_fit("verp hil", words.hil.link, params);
  if (endpoint.kind != link::Endpoint::Kind::kSerial) return;
  if (words.real_time) {
    const std::string trouble = bus::adapter_too_slow(params, endpoint);
    if (!trouble.empty()) throw cli::ToolError(cli::kNoDevice, "verp hil: " + trouble);
  }
  const std::string advice = link::latency_advice(endpoint.place);
  if (!advice.empty()) cli::complain("verp hil: " + advice);
}

cli::Json to_json(const HilResult& result) {
  cli::Json link = {{"losses", result.losses}, {"overruns", result.overruns}};
  if (result.real_time) {
    if (result.can) {
      link["frames"] = result.can->heard;
      link["dropped"] = result.can->dropped;
      link["skipped_us"] = result.can->skipped_us;
    } else {
      link["bytes"] = result.realtime.bytes;
      link["lost"] = result.realtime.lost;
      link["skipped_us"] = result.realtime.skipped_us;
    }
    link["late"] = result.realtime.late;
    link["worst_late_us"] = result.realtime.worst_late_us;
  } else {
    link["polls"] = result.lockstep.polls;
    link["repeats"] = result.lockstep.repeats;
    link["damaged"] = result.lockstep.damaged;
    link["greetings"] = result.lockstep.greetings;
  }
  return {{"pace", result.real_time ? "real time" : "lockstep"},
          {"ticks_per_s", result.ticks_per_s()},
          {"compared_ticks", result.compared},
          {"controller_resets", result.resets},
          {"link", link}};
}

std::string to_text(const HilResult& result) {
  std::string out = fmt::format("  {:<18}{:.0f}, {}\n", "ticks per second", result.ticks_per_s(),
                                result.real_time ? "in real time" : "in lockstep");
  out += result.compared > 0
             ? fmt::format("  {:<18}{} ticks told by the controller, all equal to this PC's\n",
                           "digests", result.compared)
             : fmt::format("  {:<18}none compared{}\n", "digests",
                           result.real_time ? " in real time; `verp shadow` beside it does" : "");
  if (result.resets > 0) {
    out += fmt::format("  {:<18}{} times; what is told of it is of the last start\n",
                       "controller reset", result.resets);
  }
  if (result.can) {
    out += fmt::format("  {:<18}{} frames heard, {} dropped\n", "master", result.can->heard,
                       result.can->dropped);
  }
  if (result.real_time && !result.can && result.realtime.lost > 0) {
    out += fmt::format("  {:<18}{} that came while a servo was answering\n", "lost requests",
                       result.realtime.lost);
  }
  const std::uint64_t skipped_us = result.can ? result.can->skipped_us : result.realtime.skipped_us;
  if (skipped_us > 0) {
    out += fmt::format("  {:<18}{:.1f} s of the clock, in which this PC was too slow\n", "skipped",
                       1e-6 * static_cast<double>(skipped_us));
  }
  if (result.real_time) {
    out += fmt::format("  {:<18}{} times over 1 ms, worst {:.1f} ms; link lost {} times\n", "late",
                       result.realtime.late,
                       1e-3 * static_cast<double>(result.realtime.worst_late_us), result.losses);
  } else {
    out += fmt::format("  {:<18}{} polls, {} answered again, {} damaged; lost {} times\n", "link",
                       result.lockstep.polls, result.lockstep.repeats, result.lockstep.damaged,
                       result.losses);
  }
  return out;
}

/// Answers for a controller that reports nothing: only the robot's motion is known.
int answer_served(const WalkPlan& plan, const WalkOptions& options, const HilResult& result) {
  const WalkResult& walk = result.walk;
  if (options.json) {
    cli::Json json = {{"model", plan.params.name},
                      {"controller", plan.board},
                      {"ticks", walk.ticks},
                      {"simulated_s", walk.simulated_s},
                      {"fallen", walk.metrics.fallen},
                      {"let_go_and_lies", result.lay_down},
                      {"fall_story", fall_story_json(walk)},
                      {"set_upright_s", walk.set_upright_s},
                      {"met", result.met},
                      {"interrupted", walk.interrupted},
                      {"failure", walk.failure},
                      {"real_time_factor", walk.real_time_factor()}};
    json.update(to_json(result));
    cli::print_json(json);
  } else {
    cli::answer(fmt::format("{}: served {:.1f} s{}\n", plan.params.name, walk.simulated_s,
                            walk.metrics.fallen ? "; the robot fell"
                            : result.lay_down   ? "; the robot was let go, and lies"
                                                : "") +
                to_text(result));
  }
  if (!walk.failure.empty()) cli::complain("verp hil: " + walk.failure);
  if (!walk.failure.empty()) return result.device_trouble ? cli::kNoDevice : cli::kRunFailed;
  // Ctrl-C ends a server normally, but a run without a client has failed.
  if (result.met) return cli::kGood;
  cli::complain("verp hil: interrupted before anybody came");
  return cli::kRunFailed;
}

/// Only the operator's port carries orders and reports.
void refuse_without_operator(const CLI::App& app) {
  constexpr const char* kNeedIt[] = {"--record", "--record-state", "--compress", "--report",
                                     "--step",   "--velocity",     "--live"};
  for (const char* word : kNeedIt) {
    const CLI::Option* option = app.get_option_no_throw(word);
    if (option == nullptr || option->count() == 0) continue;
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp hil: {} needs --operator, which alone takes orders to the "
                    "controller and brings what it tells; give it or leave out {}",
                    word, word));
  }
}

int run_hil(const CLI::App& app, HilWords words) {
  WalkOptions& options = words.walk;
  const bool gives_orders = !words.hil.operator_link.empty();
  Walk walk = walk_of(options, gives_orders);
  WalkPlan& plan = walk.run.plans.front();
  plan.board = words.hil.link;
  if (plan.fault && plan.fault->line) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp hil: --fault {}: this bug is of a cable, and yours is "
                                     "real; give it to verp walk",
                                     options.fault));
  }
  check(words, plan.params);
  if (!gives_orders) refuse_without_operator(app);
  if (gives_orders && options.report_folder.empty() && !options.json)
    options.report_folder = "report";
  std::optional<imu::ImuServer> chip;
  if (!words.imu_link.empty()) {
    chip.emplace(words.imu_link, plan.params.imu);
    words.hil.turned = [&chip](sim::Plant& plant) { chip->measured(plant.imu()); };
  }
  LiveStream live("verp hil", options.live);
  WalkFiles files(options, plan, metadata_of(options, plan, walk.scenario), live.robot());
  cli::Progress progress(!options.json);
  KeptTrace kept(files.trace(), files.wants_report());
  const HilResult result = serve_controller(walk.run, words.hil, progress, {&kept, &live});
  if (!gives_orders) return answer_served(plan, options, result);
  cli::Json more = to_json(result);
  live.add_to(more);
  more["changes"] = touch_json(result.walk);
  const int status = finish_walk(plan, options, walk.scenario.robots[0].orders, files, result.walk,
                                 {}, more, touch_text(result.walk) + to_text(result) + live.text());
  // Ctrl-C on a silent link is no device failure.
  const bool device = result.device_trouble && !result.walk.interrupted;
  return status != cli::kGood && device ? cli::kNoDevice : status;
}

}  // namespace

cli::Subcommand add_hil(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "hil");
  auto words = std::make_shared<HilWords>();
  words->walk.command = words->walk.touch.command = "verp hil";
  declare_basics(*app, words->walk);
  declare_twin(*app, words->walk);
  declare_push(*app, words->walk.touch);
  app->get_option("--get-up")
      ->description(
          "a fall ends nothing: with --operator the robot gets up by the controller's own actions "
          "and "
          "walks on; without, whoever drives it may get it up");
  declare_live(*app, words->walk.live);
  app->get_option("--for")->description(
      "with --operator: length of the gait, all three phases, s; without: how long the robot is "
      "served from when a servo first has torque, s, or until Ctrl-C, which is no failure then");
  app->add_option("--link", words->hil.link,
                  "the controller's servo bus: serial:DEVICE@BAUD, pty:PATH, tcp:HOST:PORT, "
                  "tcp-listen:PORT, unix:PATH, unix-listen:PATH or can:INTERFACE")
      ->required();
  app->add_option("--operator", words->hil.operator_link,
                  "its operator's port: orders go there, digests come back");
  app->add_option("--imu-serial", words->imu_link,
                  "serves the twin's IMU there, too, as a BNO055 on a serial line: pty:PATH, for "
                  "verp run --imu serial:PATH,bno055");
  CLI::Option* lockstep = app->add_flag("--lockstep", words->lockstep,
                                        "time stands until the controller announces lockstep");
  app->add_flag("--realtime", words->real_time, "time goes on by the clock on the wall")
      ->excludes(lockstep);
  return {app, [app, words] {
            cli::catch_interrupts();
            return run_hil(*app, *words);
          }};
}

}  // namespace verp::tool
