#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/controller_table.hpp"
#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/tool/robot/action_convert.hpp"
#include "host/apps/tool/robot/action_words.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/author/action/check.hpp"
#include "host/author/action/folder.hpp"
#include "host/author/action/kept.hpp"
#include "host/author/action/play.hpp"
#include "host/author/action/send.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::tool {
namespace {

struct SendWords {
  std::string link;
  int id = -1;  ///< default: the controller on that link
};

std::unique_ptr<action::ActionPort> open(const SendWords& send) {
  const link::Endpoint endpoint = link::parse_endpoint(send.link);
  const bool can = endpoint.kind == link::Endpoint::Kind::kCan;
  const int usual = can ? canopen::plan::kControllerNode : dxl::controller::kDefaultId;
  const auto id = static_cast<std::uint8_t>(send.id >= 0 ? send.id : usual);
  return can ? action::can_action_port(endpoint, id) : action::serial_action_port(endpoint, id);
}

void require_actions(const ActionRobot& robot) {
  if (!robot.made.documents.empty()) return;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp action send: {} has no actions in {}; write one: "
                  "host/guide/actions.md has the words",
                  robot.entity.name, action::folder_of(robot.entity.file).string()));
}

/// `verp action send`, to a running controller. Returns the exit status.
int send_actions(const ActionWords& words, const SendWords& send) {
  if (!words.action.empty() && !words.action.ends_with(".action")) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp action send: --add {}: actions are *.action; all "
                                     "of the robot's own are sent anyway",
                                     words.action));
  }
  const ActionRobot robot = load_action_robot(words);
  require_actions(robot);
  const std::vector<std::uint8_t> image = action::kept_image(robot.made, robot.params);
  const int count = static_cast<int>(robot.made.documents.size());
  const auto port = open(send);
  cli::Progress progress(!words.json);
  const auto all = static_cast<double>(image.size());
  const bool sent = action::send_actions(
      *port, image, {.robot = robot.params.name, .actions = count, .went = [&](std::size_t bytes) {
                       progress.show(static_cast<double>(bytes) / all,
                                     fmt::format("{} bytes", bytes));
                       return !cli::interrupted();
                     }});
  progress.clear();
  if (!sent) {
    cli::complain(send.link + ": interrupted; the controller keeps the actions that it has");
    return cli::kRunFailed;
  }
  cli::print_answer(words.json,
                    {{"model", robot.entity.name}, {"actions", count}, {"bytes", image.size()}},
                    fmt::format("{}: {} actions of {}, {} bytes, in force\n", port->place(), count,
                                robot.entity.name, image.size()));
  return cli::kGood;
}

constexpr double kDegreesOfRad = 180 / std::numbers::pi;
constexpr double kStand_m = 1;  ///< no leg of such a robot reaches the floor

cli::Json facts(const action::CompiledActions& made, int number) {
  const action::Library library = made.library();
  const action::Action& own = library.action(number);
  const action::Document& document = made.documents[static_cast<std::size_t>(number - 1)];
  return {{"number", number},
          {"name", document.name},
          {"note", document.note},
          {"frames", own.frames},
          {"file", document.file.string()}};
}

int list(const ActionWords& words) {
  const ActionRobot robot = load_action_robot(words);
  cli::Json rows = cli::Json::array();
  std::string text = fmt::format("{}: {} actions, an image of {} bytes\n", robot.entity.name,
                                 robot.made.documents.size(), 4 * robot.made.words.size());
  for (int i = 1; i <= robot.made.library().count(); ++i) {
    const cli::Json row = facts(robot.made, i);
    text += fmt::format("  {:>3} {:<16} {:>3} frames  {}\n", i, row["name"].get<std::string>(),
                        row["frames"].get<int>(), row["note"].get<std::string>());
    rows.push_back(row);
  }
  cli::print_answer(words.json, {{"model", robot.entity.name}, {"actions", rows}}, text);
  return cli::kGood;
}

int show(const ActionWords& words) {
  const ActionRobot robot = load_action_robot(words);
  const int number = require_action(robot, words);
  const action::Document& document = robot.made.documents[static_cast<std::size_t>(number - 1)];
  if (!words.json) {
    cli::answer(action::text_of(document));
    return cli::kGood;
  }
  const action::Library library = robot.made.library();
  const action::Action& own = library.action(number);
  cli::Json json = facts(robot.made, number);
  json["frames"] = cli::Json::array();
  for (int i = own.first; i < own.first + own.frames; ++i) {
    const action::Frame& frame = library.frame(i);
    cli::Json goals = cli::Json::object();
    for (int j = 0; j < robot.params.joint_count; ++j) {
      if ((frame.joints >> j & 1U) != 0) {
        goals[robot.params.joint[j].name] = 1e-4 * frame.goal_tenth_mrad[j];
      }
    }
    json["frames"].push_back({{"line", robot.made.line[static_cast<std::size_t>(i)]},
                              {"time_s", 1e-3 * frame.time_ms},
                              {"pause_s", 1e-3 * frame.pause_ms},
                              {"goals_rad", goals}});
  }
  cli::print_json(json);
  return cli::kGood;
}

std::string in_a_line(const action::FrameCheck& each) {
  const std::string place = each.frame < 0 ? "  back" : fmt::format("{:>6}", each.line);
  const std::string zmp =
      each.zmp_margin_m >= 1 ? "-" : fmt::format("{:.0f}", 1e3 * each.zmp_margin_m);
  return fmt::format("  {} {:>6.2f} {:>6.2f} {:>6.0f} {:<18} {:>6.0f} {:<18} {:>5}  {}\n", place,
                     each.begin_s, each.end_s, 100 * each.speed_share, each.fastest,
                     100 * each.torque_share, each.hardest, zmp,
                     each.problem.empty() ? "good" : each.problem);
}

int check(const ActionWords& words) {
  const ActionRobot robot = load_action_robot(words);
  cli::Json rows = cli::Json::array();
  std::string text;
  int bad = 0;
  const int only = words.action.empty() ? 0 : require_action(robot, words);
  for (int number = 1; number <= robot.made.library().count(); ++number) {
    if (only != 0 && number != only) continue;
    const action::ActionCheck checked =
        action::check(robot.entity, robot.params, robot.made, number);
    const action::Document& document = robot.made.documents[static_cast<std::size_t>(number - 1)];
    cli::Json frames = cli::Json::array();
    text += fmt::format("{} on {}: {:.2f} s{}\n", document.name, robot.entity.name,
                        checked.length_s, checked.whole ? "" : ", and on: not checked further");
    text += fmt::format("  {:>6} {:>6} {:>6} {:>6} {:<18} {:>6} {:<18} {:>5}\n", "line", "from s",
                        "to s", "speed%", "of", "weight%", "on", "ZMPmm");
    std::set<std::pair<int, std::string>> told;
    for (const action::FrameCheck& each : checked.frames) {
      if (told.insert({each.frame, each.problem}).second) text += in_a_line(each);
      frames.push_back(
          {{"line", each.line},
           {"begin_s", each.begin_s},
           {"end_s", each.end_s},
           {"speed_share", each.speed_share},
           {"torque_share", each.torque_share},
           {"zmp_margin_m", each.zmp_margin_m >= 1 ? cli::Json() : cli::Json(each.zmp_margin_m)},
           {"problem", each.problem}});
    }
    if (const std::size_t again = checked.frames.size() - told.size(); again > 0)
      text += fmt::format("  {:>6} times more one of these, alike\n", again);
    const action::FrameCheck* first = checked.first_bad();
    if (first != nullptr) {
      ++bad;
      cli::complain(fmt::format("verp action check: {}:{}: {}", document.file.string(), first->line,
                                first->problem));
    }
    rows.push_back({{"action", document.name},
                    {"good", first == nullptr},
                    {"length_s", checked.length_s},
                    {"whole", checked.whole},
                    {"frames", frames}});
  }
  cli::print_answer(words.json, {{"model", robot.entity.name}, {"actions", rows}}, text);
  return bad == 0 ? cli::kGood : cli::kRunFailed;
}

/// Empty: the robot stayed.
std::string way_in_words(const action::PlayedAction& played) {
  constexpr double kStayed_m = 0.05, kStayed_rad = 0.1;
  if (played.went_m.norm() < kStayed_m && std::abs(played.turned_rad) < kStayed_rad) return "";
  return fmt::format("  {:<18}{:.2f} m ahead, {:.2f} m to the left, turned by {:.0f} degrees\n",
                     "went", played.went_m.x(), played.went_m.y(),
                     played.turned_rad * kDegreesOfRad);
}

int play(const ActionWords& words) {
  const ActionRobot robot = load_action_robot(words);
  const int number = require_action(robot, words);
  WalkOptions options = words.walk;
  options.model = words.model;
  options.json = words.json;
  const Walk walk = walk_of(options);
  WalkPlan plan = walk.run.plans.front();
  plan.actions = robot.made.words;
  const Drawn drawn = drawn_of(walk);
  if (words.gains_percent < 100) {
    soften(plan.entity, words.gains_percent);
    plan.params = model::make_params(plan.entity);
  }
  if (words.held) {
    plan.twin.cradle = sim::Cradle::kAlways;
    plan.twin.start_m.z() += kStand_m;
    plan.params.tuning.safety.unloaded_s = 3600;  // it hangs
  }
  record::mcap::StringMap metadata = metadata_of(options, plan, walk.scenario);
  metadata["action"] = words.action;
  WalkFiles files(options, plan, metadata);
  cli::Progress progress(!words.json);
  session::Hooks hooks;
  hooks.trace = files.trace();
  hooks.ticked = [&](const session::Tick& tick) {
    progress.show(0, fmt::format("{}  {:.1f} s", words.action, tick.seen.truth.t_s));
  };
  action::PlayedAction played = action::play(
      plan, number, std::move(hooks), {.world = walk.run.world, .interrupted = cli::interrupted});
  progress.clear();
  const session::WalkResult& run = played.run;
  files.finish(run, {});
  const std::string digest = fmt::format("0x{:016x}", run.digest);
  if (words.json) {
    cli::Json json = {{"model", plan.entity.name},
                      {"action", words.action},
                      {"asked_s", played.asked_s},
                      {"action_s", played.action_s},
                      {"ahead_m", played.went_m.x()},
                      {"left_m", played.went_m.y()},
                      {"turned_deg", played.turned_rad * kDegreesOfRad},
                      {"fallen", run.metrics.fallen},
                      {"ticks", run.ticks},
                      {"digest", digest},
                      {"failure", run.failure}};
    json.update(drawn.json);
    files.add_to(json);
    cli::print_json(json);
  } else {
    cli::answer(
        fmt::format("{} played {}: {:.2f} s, from {:.2f} s of the run on; {} ticks, digest {}\n",
                    plan.entity.name, words.action, played.action_s, played.asked_s, run.ticks,
                    digest) +
        way_in_words(played) + drawn.text + files.text());
  }
  for (const std::string& line : files.lost()) cli::complain(line);
  if (run.good()) return files.lost().empty() ? cli::kGood : cli::kRunFailed;
  cli::complain("verp action play: " + (run.failure.empty() ? "interrupted" : run.failure));
  return cli::kRunFailed;
}

}  // namespace

cli::Subcommand add_action(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "action");
  app->require_subcommand(1);
  auto words = std::make_shared<ActionWords>();
  const auto add = [&](const char* name, const char* help, bool named) {
    CLI::App* each = app->add_subcommand(name, help);
    if (named) {
      each->add_option("ACTION", words->action, "its name, or an action file");
    }
    cli::add_model(*each, words->model)->capture_default_str();
    cli::add_json_flag(*each, words->json);
    return each;
  };
  CLI::App* lists = add("list", "What actions a robot has", false);
  CLI::App* shows = add("show", "An action as text; --json: as the robot's joints have it", true);
  shows->get_option("ACTION")->required();
  CLI::App* checks = add("check",
                         "Limits, speed, weight, collisions and ZMP, frame by frame; exit 1 names "
                         "the first that fails",
                         true);
  CLI::App* plays = add("play", "Play an action in the twin", true);
  plays->get_option("ACTION")->required();
  plays->add_option("--seed", words->walk.seed, "of every random thing in the twin")
      ->check(cli::whole_number_between(0, 4294967295))
      ->capture_default_str();
  plays->add_flag("--vary", words->walk.vary, "another robot of this kind, drawn from the seed");
  plays->add_flag("--held", words->held,
                  "the trunk hangs in a stand all the time, feet in the air");
  plays->add_option("--gains", words->gains_percent, "of the servos' position loops, percent")
      ->check(cli::whole_number_between(10, 100))
      ->capture_default_str();
  plays->add_option("--record", words->walk.record_file, "write the trace here (.mcap)");
  words->walk.command = "verp action play";
  CLI::App* converts =
      add("convert", "Between action files, CSV tables and ROBOTIS motion files (*.bin)", false);
  auto convert = std::make_shared<ConvertWords>();
  converts->remove_option(converts->get_option("MODEL"));
  converts->add_option("FROM", convert->from, "an action, FILE.csv, MOTION.bin or a folder")
      ->required();
  converts->add_option("TO", convert->to, "FILE.csv, FILE.action, a folder or MOTION.bin")
      ->required();
  converts->add_option("--robot", words->model, "a robot by its name, or the path of its SDF file")
      ->capture_default_str();
  CLI::App* exports = add(
      "export", "All actions of a robot as a board keeps them, for verp flash --actions", false);
  exports->remove_option(exports->get_option("--json"));
  auto exported = std::make_shared<std::string>();
  exports->add_option("-o,--output", *exported, "the file (FILE.bin)")->required();
  CLI::App* sends = add("send", "All actions of a robot to its controller, which runs", false);
  auto send = std::make_shared<SendWords>();
  sends->add_option("--add", words->action, "an action file, one of them, too");
  sends
      ->add_option("--link", send->link,
                   "its operator's port: serial:DEVICE@BAUD, pty:PATH, tcp:HOST:PORT, unix:PATH; "
                   "or its robot's bus: can:can0")
      ->required();
  sends->add_option("--id", send->id, "of the controller (default: 200; on CAN node 127)")
      ->check(cli::whole_number_between(1, 252));
  CLI::App* records = app->add_subcommand("record", "An action out of what a robot did in a trace");
  auto record = std::make_shared<RecordWords>();
  records->add_option("TRACE", record->trace, "a trace (.mcap)")->required();
  records->add_option("-o", record->file, "the action (NAME.action)")->required();
  records->add_option("--gait", record->gait_cycles, "the gait's 16 states, repeated so often")
      ->check(cli::whole_number_between(1, 255));
  records->add_option("--from", record->options.from_s, "time in the trace, s")
      ->check(cli::number_between(0, 86400, "s"));
  records->add_option("--to", record->options.to_s, "time in the trace, s")
      ->check(cli::number_between(0, 86400, "s"));
  records->add_option("--every", record->options.every_s, "between key frames, s")
      ->check(cli::number_between(0.02, 10, "s"))
      ->capture_default_str();
  CLI::App* makes = add("make",
                        "An action lie_down for a robot that has none: found in the twin, in "
                        "minutes; exit 1 if there is none",
                        true);
  makes->get_option("ACTION")
      ->required()
      ->description("lie_down")
      ->check(CLI::IsMember({action::kLieDown}));
  makes->get_option("MODEL")->required();
  makes->remove_option(makes->get_option("--json"));
  auto made = std::make_shared<std::string>();
  makes->add_option("-o,--output", *made, "the file (default: among the robot's actions)");
  return {app, [=]() -> int {
            cli::catch_interrupts();
            if (makes->parsed()) return cli::answer(make_lie_down(*words, *made)), cli::kGood;
            if (lists->parsed()) return list(*words);
            if (shows->parsed()) return show(*words);
            if (checks->parsed()) return check(*words);
            if (converts->parsed())
              return cli::answer(convert_actions(*words, *convert)), cli::kGood;
            if (exports->parsed())
              return cli::answer(export_actions(*words, *exported)), cli::kGood;
            if (sends->parsed()) return send_actions(*words, *send);
            if (records->parsed()) return cli::answer(record_action(*record)), cli::kGood;
            return play(*words);
          }};
}

}  // namespace verp::tool
