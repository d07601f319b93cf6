#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/real_time.hpp"
#include "host/apps/tool/bit_rate.hpp"
#include "host/apps/tool/robot/action_words.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/robot/first_power.hpp"
#include "host/apps/tool/robot/run_can.hpp"
#include "host/apps/tool/robot/run_lockstep.hpp"
#include "host/apps/tool/robot/run_params.hpp"
#include "host/apps/tool/robot/run_robot.hpp"
#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_report.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/author/action/get_up.hpp"
#include "host/os/link/can_claim.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/link_error.hpp"
#include "host/robot/model/bus_time.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/fault_names.hpp"
#include "host/run/session/get_up.hpp"
#include "host/run/session/stride.hpp"

namespace verp::tool {
namespace {

constexpr std::uint32_t kArrival_us = 10'000'000;  // for the other end of `pty:` or a listener

struct RunWords {
  WalkOptions walk;
  RunParams params;
  std::string link, action, stop;
  int torque_percent = 100, gains_percent = 100;
  bool yes = false;
  bool take_orders = false;
  bool get_up = false;
  bool lockstep = false;
};

/// Orders from another source are not planned beforehand: only tuning limits them.
void require_followed_orders(const Params& params) {
  const Command longest = session::longest_order(params);
  const session::FeasibleVelocity followed = session::within_servo_speed(params, longest);
  if (followed.remark.empty()) return;
  const double share = static_cast<double>(followed.velocity.vx_tenth_mm_s) / longest.vx_tenth_mm_s;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format(
          "verp run: --take-orders: the servos cannot follow every order that "
          "gait.max_step_m={:g} admits in cycles of {:g} s; give --set "
          "gait.max_step_m={:.3f}, or a longer --cycle",
          static_cast<double>(params.tuning.gait.max_step_m),
          static_cast<double>(params.tuning.gait.cycle_s),
          std::floor(1000 * share * static_cast<double>(params.tuning.gait.max_step_m)) / 1000));
}

/// Without an IMU the robot cannot sense how it lies.
void let_robot_get_up(const RunWords& words, WalkPlan& walk) {
  if (!words.params.has_imu()) {
    throw cli::ToolError(
        cli::kBadInput,
        "verp run: --get-up needs the IMU, which tells on which side the robot lies; "
        "leave out --get-up or --imu none");
  }
  walk.get_ups = session::kGetUpTries;
  action::take_get_up_actions(walk);
}

/// All of the robot's actions, as its firmware has them. A wrong file is no reason to refuse a
/// walk.
void take_actions(const RunWords& words, RunPlan& plan) {
  WalkPlan& walk = plan.walk;
  try {
    const action::CompiledActions made = make_actions(walk.entity, walk.params, words.action);
    if (!words.action.empty()) plan.action = require_action(walk.entity, made, words.action);
    if (!made.documents.empty()) walk.actions = made.words;
  } catch (const model::LoadError& error) {
    if (!words.action.empty() || walk.get_ups > 0) throw;
    cli::complain(
        fmt::format("verp run: only its action lie_down is loaded, because {}", error.what()));
    action::take_lie_down(walk);
  }
}

RunPlan make_plan(const RunWords& words) {
  RunPlan plan;
  plan.link = link::parse_endpoint(words.link);
  plan.has_imu = words.params.has_imu();
  if (const auto own = words.params.own_imu()) plan.imu_name = imu::to_text(*own);
  plan.torque_percent = words.torque_percent;
  plan.takes_orders = words.take_orders;
  plan.lockstep = words.lockstep;
  if (words.lockstep && plan.link.kind == link::Endpoint::Kind::kCan) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp run: --lockstep is for a twin on a byte link, and "
                                     "{} is a CAN interface; leave it out, in real time",
                                     words.link));
  }
  if (words.lockstep && !plan.imu_name.empty()) {
    throw cli::ToolError(cli::kBadInput, "verp run: --lockstep is in the twin's time, and " +
                                             plan.imu_name +
                                             " in this PC's; leave out one of them");
  }
  if (words.take_orders && plan.link.kind != link::Endpoint::Kind::kCan) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp run: --take-orders is for a robot on CAN, where "
                                     "the controller is a node; {} has no place for orders",
                                     words.link));
  }
  WalkPlan& walk = plan.walk;
  if (!words.stop.empty()) link::parse_stop(words.stop);
  walk.entity = model::load_robot_on_any_bus(model::find_model(words.walk.model), words.walk.bus);
  soften(walk.entity, words.gains_percent);
  walk.params = model::make_params(walk.entity);
  require_fit("verp run", words.link, walk.params);
  scenario::tune(tuning_of(words.walk), walk.params.tuning);
  apply_run_params(words.params, walk.params);
  model::require_bus(walk.entity, walk.params);
  if (words.action.empty()) {
    scenario::give_orders(orders_of(words.walk), walk);
    walk.walk_s = words.walk.walk_s;
  }
  if (words.take_orders) require_followed_orders(walk.params);
  if (words.get_up) let_robot_get_up(words, walk);
  take_actions(words, plan);
  if (plan.link.kind == link::Endpoint::Kind::kSerial && plan.link.baud != walk.params.baud) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp run: the link runs at {} baud, the bus of {} at "
                                     "{}; give --link serial:{}@{}, or change baud in "
                                     "<verp:bus>",
                                     plan.link.baud, walk.params.name, walk.params.baud,
                                     plan.link.place, walk.params.baud));
  }
  return plan;
}

const char* scheduler_name(const cli::RealTime& got) {
  return got.fifo ? "SCHED_FIFO" : "an ordinary program's";
}

std::string imu_word(const RunPlan& plan) {
  return !plan.has_imu ? "none" : plan.imu_name.empty() ? "bus" : plan.imu_name;
}

cli::Json to_json(const RunPlan& plan, const RunResult& result) {
  const WalkResult& walk = result.walk;
  const app::Deadlines& deadlines = result.deadlines;
  const bus::LinkFit& fit = result.fit;
  return {{"model", plan.walk.params.name},
          {"link", link::to_text(plan.link)},
          {"imu", imu_word(plan)},
          {"period_us", plan.walk.params.period_us},
          {"ticks", walk.ticks},
          {"walked_s", result.walked_s},
          {"action_s", plan.action == 0 ? cli::Json() : cli::Json(result.played_s)},
          {"falls", walk.falls},
          {"get_ups", walk.get_ups},
          {"fall_story", fall_story_json(walk)},
          {"wall_s", walk.wall_s},
          {"digest", fmt::format("0x{:016x}", walk.digest)},
          {"faults", session::fault_names(walk.faults)},
          {"ended", result.ended},
          {"failure", walk.failure},
          {"interrupted", walk.interrupted},
          {"torque_percent", plan.torque_percent},
          {"lockstep", plan.lockstep},
          {"let_go", result.silent_servos + result.stiff_servos == 0},
          {"deadlines",
           {{"missed", deadlines.missed},
            {"skipped_periods", deadlines.skipped},
            {"worst_late_us", deadlines.worst_late_us}}},
          {"latency",
           {{"reads", fit.delay.answered},
            {"median_us", fit.delay.median_us},
            {"p90_us", fit.delay.p90_us},
            {"worst_us", fit.delay.worst_us},
            {"wire_us", fit.wire_us},
            {"needed_us", fit.needed_us()}}},
          {"bus",
           {{"timeouts", result.bus.timeouts},
            {"crc_errors", result.crc_errors},
            {"strays", result.bus.strays},
            {"refused", result.bus.refused},
            {"overruns", result.link.overruns},
            {"losses", result.link.losses}}},
          {"real_time", {{"fifo", result.real_time.fifo}, {"locked", result.real_time.locked}}}};
}

std::string row(const char* name, const std::string& what) {
  return fmt::format("  {:<18}{}\n", name, what);
}

std::string real_time_text(const RunResult& result) {
  const app::Deadlines& deadlines = result.deadlines;
  return row("deadlines", fmt::format("{} missed, {} periods skipped, latest tick {:.1f} ms late",
                                      deadlines.missed, deadlines.skipped,
                                      1e-3 * static_cast<double>(deadlines.worst_late_us))) +
         row("scheduling", fmt::format("{}{}", scheduler_name(result.real_time),
                                       result.real_time.locked ? ", memory locked" : "")) +
         row("latency",
             fmt::format("a read held up for {:.2f} ms, slowest tenth {:.2f}",
                         1e-3 * result.fit.delay.median_us, 1e-3 * result.fit.delay.p90_us));
}

std::string to_text(const RunPlan& plan, const RunResult& result) {
  const bool acted = plan.action != 0;
  const char* did = acted ? "acted for" : plan.walk.stands ? "stood for" : "walked";
  return fmt::format("{}: {} {:.1f} s on {}\n", plan.walk.params.name, did,
                     acted ? result.played_s : result.walked_s, link::to_text(plan.link)) +
         row("ticks", fmt::format("{} of {:g} ms, digest 0x{:016x}", result.walk.ticks,
                                  1e-3 * plan.walk.params.period_us, result.walk.digest)) +
         (plan.walk.get_ups > 0 ? row("falls", fmt::format("{}; got up {} times", result.walk.falls,
                                                           result.walk.get_ups))
                                : "") +
         (plan.lockstep ? row("time", "the twin's, in lockstep") : real_time_text(result)) +
         row("bus",
             fmt::format("{} timeouts, {} {}, {} overruns; link lost {} times", result.bus.timeouts,
                         result.crc_errors,
                         plan.walk.params.bus_protocol == BusProtocol::kCia402 ? "error frames"
                                                                               : "CRC errors",
                         result.link.overruns, result.link.losses)) +
         row("IMU", !plan.has_imu ? "none: upright was assumed, balance was off"
                    : plan.imu_name.empty()
                        ? fmt::format("device {}", plan.walk.params.imu.device_id)
                        : plan.imu_name) +
         row("ended", result.ended) +
         row("torque", result.silent_servos + result.stiff_servos == 0
                           ? "off, said every servo"
                           : "NOT known to be off everywhere");
}

int tell(const RunWords& words, const RunPlan& plan, WalkFiles& files, LiveStream& live,
         const RunResult& result) {
  live.finish();
  files.finish(result.walk, {});
  if (words.walk.json) {
    cli::Json json = to_json(plan, result);
    live.add_to(json);
    files.add_to(json);
    cli::print_json(json);
  } else {
    cli::answer(to_text(plan, result) + live.text() + files.text());
  }
  for (const std::string& line : files.lost()) cli::complain(line);
  const std::string& failure = result.walk.failure;
  if (!failure.empty()) cli::complain("verp run: " + failure);
  if (!failure.empty() && result.device_trouble) return cli::kNoDevice;
  return result.walk.good() && files.lost().empty() ? cli::kGood : cli::kRunFailed;
}

template <class Link>
int run_on(Link& link, const RunWords& words, const RunPlan& plan, WalkFiles& files,
           LiveStream& live) {
  const bus::LinkFit fit = check_latency(link, plan);
  check_imu(link, plan);
  if (!plan.has_imu) {
    cli::complain(
        "verp run: no IMU: the controller is told that the body is upright and still; balance is "
        "off, and a fall is not noticed");
  }
  cli::Answers answers;
  // Ask on every link: tcp: or pty: may lead to a real robot.
  confirm_first_power(plan.walk.params, words.yes, answers);
  live.run_beside_real_time();
  cli::Progress progress(!words.walk.json);
  return tell(words, plan, files, live, drive(link, plan, fit, files.trace(), progress));
}

/// The IMU of this PC, open and measuring; null without one.
std::unique_ptr<imu::ImuPort> open_imu(const RunWords& words) {
  const auto place = words.params.own_imu();
  if (!place) return nullptr;
  auto port = std::make_unique<imu::ImuPort>(*place, [] { return cli::interrupted(); });
  if (cli::interrupted())
    throw cli::ToolError(cli::kRunFailed, "verp run: interrupted; torque was never on");
  port->start(cli::kLoopPriority + 1);
  return port;
}

/// The stop button of this PC, not pressed; null without one.
std::unique_ptr<link::StopLine> open_stop(const RunWords& words) {
  if (words.stop.empty()) return nullptr;
  auto stop = std::make_unique<link::StopLine>(link::parse_stop(words.stop));
  if (!stop->is_pressed()) return stop;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp run: the stop button at {} is pressed, or its circuit is "
                                   "open; release it, or check its wires to ground",
                                   stop->name()));
}

/// Retries, because a lockstep twin and its controllers start in any order.
link::Link open_link(const RunPlan& plan) {
  using Kind = link::Endpoint::Kind;
  constexpr std::uint32_t kTry_us = 100'000;
  const bool socket = plan.link.kind == Kind::kUnix || plan.link.kind == Kind::kTcp;
  for (std::uint32_t waited_us = 0;; waited_us += kTry_us) {
    try {
      return link::Link(plan.link);
    } catch (const link::LinkError& error) {
      const bool absent = error.kind() == link::LinkError::Kind::kNoDevice ||
                          error.kind() == link::LinkError::Kind::kRefused;
      const bool patient = plan.lockstep && socket && absent;
      if (!patient || waited_us >= kArrival_us || cli::interrupted()) throw;
      if (waited_us == 0) cli::complain("verp run: waiting for the twin at " + to_text(plan.link));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(kTry_us));
  }
}

int run_robot(const RunWords& words) {
  RunPlan plan = make_plan(words);
  if (!plan.walk.remark.empty()) cli::complain("verp run: " + plan.walk.remark);
  LiveStream live("verp run", words.walk.live);
  record::mcap::StringMap facts = metadata_of(words.walk, plan.walk, scenario_of(words.walk, {}));
  facts["link"] = words.link;
  facts["imu"] = plan.has_imu ? imu_word(plan) : "none: assumed upright";
  if (plan.action != 0) facts["action"] = words.action;
  if (words.gains_percent < 100) facts["gains_percent"] = std::to_string(words.gains_percent);
  WalkFiles files(words.walk, plan.walk, facts, live.robot());
  const std::unique_ptr<imu::ImuPort> own_imu = open_imu(words);
  plan.own_imu = own_imu.get();
  const std::unique_ptr<link::StopLine> stop = open_stop(words);
  plan.stop = stop.get();
  live.wait_for_viewer();
  if (plan.link.kind == link::Endpoint::Kind::kCan) {
    link::CanPort port(plan.link);
    check_bit_rate("verp run", port.interface(), plan.walk.params);
    const link::CanClaim claim(port.interface().name, "controller", "`verp run`");
    refuse_second_controller(port, plan);
    return run_on(port, words, plan, files, live);
  }
  link::Link link = open_link(plan);
  if (!link.connected()) {
    cli::complain("verp run: waiting for the robot on " + link.place());
    for (std::uint32_t i = 0; i < 100 && !cli::interrupted(); ++i) {
      if (link.wait_connected(kArrival_us / 100)) break;
    }
  }
  if (!plan.lockstep) return run_on(link, words, plan, files, live);
  cli::Progress progress(!words.walk.json);
  return tell(words, plan, files, live, drive_in_lockstep(link, plan, files.trace(), progress));
}

}  // namespace

cli::Subcommand add_run(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "run");
  auto words = std::make_shared<RunWords>();
  words->walk.command = "verp run";
  declare_gait(*app, words->walk);
  declare_tuning(*app, words->walk);
  app->add_option("--link", words->link,
                  "the robot's servo bus: serial:DEVICE@BAUD, pty:PATH, tcp:HOST:PORT, "
                  "unix:PATH, can:can0")
      ->required();
  declare_run_params(*app, words->params);
  app->add_option("--torque", words->torque_percent, "of what the servos can, percent")
      ->check(cli::whole_number_between(5, 100))
      ->capture_default_str();
  app->add_option("--gains", words->gains_percent, "of the servos' position loops, percent")
      ->check(cli::whole_number_between(10, 100))
      ->capture_default_str();
  app->add_option("--action", words->action,
                  "instead of a walk: stand, play this action (its name, or a file), sit down")
      ->excludes("--velocity")
      ->excludes("--step")
      ->excludes("--for");
  app->add_flag("--get-up", words->get_up,
                "a fall ends no walk, and one that lies begins it: the robot falls softly, gets up "
                "by its actions fall_safe and get_up_..., three tries, and walks on")
      ->excludes("--action");
  app->add_option("--stop", words->stop,
                  "gpio:/dev/gpiochip0,17: a stop button of this PC, a normally closed contact to "
                  "ground; an open circuit stops the robot");
  app->add_flag("--yes", words->yes, "the first-power checklist is confirmed; for a twin, too");
  app->add_option("--record", words->walk.record_file, "write the trace here (.mcap)");
  app->add_flag("--record-state", words->walk.record_state,
                "keep the full State of every tick in the trace");
  app->add_flag("--compress", words->walk.compress, kCompress);
  app->add_flag("--take-orders", words->take_orders,
                "on CAN: whoever writes the controller's node (127) gives the orders, for --for "
                "seconds or until Ctrl-C; the bytes: host/guide/canopen.md")
      ->excludes("--velocity")
      ->excludes("--get-up")
      ->excludes("--action");
  app->add_flag(
         "--lockstep", words->lockstep,
         "a twin is at the other end (`verp walk --robot NAME=ext:LINK`), and its time waits "
         "for this controller: nothing is late, however slow either is")
      ->excludes("--take-orders");
  declare_live(*app, words->walk.live);
  cli::add_json_flag(*app, words->walk.json);
  return {app, [words] {
            cli::catch_interrupts_to_the_end();
            return run_robot(*words);
          }};
}

}  // namespace verp::tool
