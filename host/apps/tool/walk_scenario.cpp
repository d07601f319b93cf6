#include "host/apps/tool/walk_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/model/tuning_ranges.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/apps/tool/radio_words.hpp"
#include "host/author/action/get_up.hpp"
#include "host/boards/flash/recipe.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/scenario/text.hpp"
#include "host/twin/sim/scenery.hpp"

namespace verp::tool {

using scenario::Scenario;

scenario::World world_of(const WalkOptions& options) {
  return {.file = options.place.world, .physics_step_ms = options.physics_step_ms};
}

sim::Lies lies_of(const WalkOptions& options) {
  return *scenario::start_of(options.start);
}

scenario::Robot robot_of(const WalkOptions& options) {
  return {.name = {},
          .model = options.model,
          .bus = options.bus,
          .tuning = tuning_of(options),
          .orders = orders_of(options),
          .controller = {.folder = options.controller, .board = options.board, .link = {}},
          .seed = options.seed,
          .vary = options.vary,
          .at = {},
          .lies = lies_of(options),
          .get_up = options.get_up,
          .disturbances = {},
          .fault = {}};
}

namespace {

/// Throws ToolError with the known boards. `where`: the place that names `board`.
void check_board(const std::string& board, const std::string& where) {
  if (board.empty()) return;
  std::string names;
  for (const flash::Recipe& each : flash::recipes()) {
    if (each.chip != nullptr) continue;  // has a port, no semihosting
    if (board == each.board) return;
    names += (names.empty() ? "" : ", ") + std::string(each.board);
  }
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{} {}: no emulated board that takes its twin from here; "
                                   "give one of: {}; others walk in `./verp test --on BOARD`",
                                   where, board, names));
}

/// Suggests names for the wrong name of a disturbance.
std::string hint(const scenario::ScenarioError& error, const session::Intervention& what) {
  if (error.known.empty()) return "; raise --for";
  if (std::find(error.known.begin(), error.known.end(), what.name) != error.known.end()) return "";
  const std::string meant = cli::did_you_mean(what.name, error.known);
  return meant.empty() ? "; `verp walk --list-quantities` lists them" : meant;
}

/// The option of the wrong value, and the remedy.
std::string in_words(const WalkOptions& options, const Scenario& scenario,
                     const scenario::ScenarioError& error) {
  const std::string& command = options.command;
  const std::string what = error.what();
  if (!options.scenario_file.empty())
    return fmt::format("{}: {}: {}", options.scenario_file, error.where, what);
  if (error.where.ends_with("tuning")) return fmt::format("{}: --set: {}", command, what);
  if (error.where.ends_with("bus")) return fmt::format("{} --on: {} with --bus", command, what);
  if (error.where.ends_with("folder"))
    return fmt::format("{} --controller: {}; leave --get-up and --start out", command, what);
  if (error.where.ends_with("fault")) {
    const std::string meant =
        error.known.empty() ? "" : cli::did_you_mean(options.fault, error.known);
    return fmt::format("{} --fault: {}{}", command, what,
                       meant.empty() ? "; `verp faults` lists them" : meant);
  }
  const auto number_in = [&](std::size_t bracket) {
    return std::stoul(error.where.substr(bracket + 1));
  };
  const auto robot = number_in(error.where.find('[')), i = number_in(error.where.rfind('['));
  return fmt::format("{}: {}: {}{}", command, option_of(options.touch, i), what,
                     hint(error, scenario.robots.at(robot).disturbances.at(i)));
}

void require_alone(const WalkOptions& options) {
  if (options.board.empty()) return;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: several robots; say whose controller runs on the "
                                   "board: --robot NAME=on:{}",
                                   options.command, options.board));
}

/// The world's robots. The options may set the controllers of those that they name.
std::vector<Seat> seats_of_world(const WalkOptions& options, const model::World& world) {
  std::vector<Seat> seats;
  for (const model::WorldRobot& robot : world.robots)
    seats.push_back({.name = robot.name, .model = robot.file, .link = {}, .board = {}});
  for (const Seat& named : seats_of(options.command, options.team)) {
    const auto same = std::find_if(seats.begin(), seats.end(),
                                   [&](const Seat& each) { return each.name == named.name; });
    if (same == seats.end() || !named.model.empty()) {
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("{}: {} has robots of its own; of these, --robot "
                                       "NAME=ext:LINK or NAME=on:BOARD may say who drives them",
                                       options.command, world.file));
    }
    same->link = named.link;
    same->board = named.board;
  }
  return seats;
}

/// Throws ToolError if MODEL is unused.
void check_model(const WalkOptions& options, const std::vector<Seat>& seats,
                 const model::World* world) {
  if (!options.model_given) return;
  if (world != nullptr) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: {} has robots of its own; leave MODEL out, or take "
                                     "its <include>s out",
                                     options.command, world->file));
  }
  const bool of_nobody =
      !seats.empty() &&
      std::none_of(seats.begin(), seats.end(), [](const Seat& seat) { return seat.model.empty(); });
  if (!of_nobody) return;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("{0}: {1} has no name, and each robot that has one has a model of its own; add "
                  "--robot NAME={1}, or leave it out (names have letters, digits, _ and -)",
                  options.command, options.model));
}

scenario::Robot robot_of(const WalkOptions& options, const Seat& seat, std::size_t index) {
  scenario::Robot robot = tool::robot_of(options);
  robot.name = seat.name;
  if (!seat.model.empty()) robot.model = seat.model;
  robot.controller.board = seat.board;
  robot.controller.link = seat.link;
  robot.seed = options.seed + index;
  const sim::Vec2 at = place_in_column(index);
  robot.at = {.x_m = at.x(), .y_m = at.y(), .yaw_rad = 0};
  return robot;
}

std::vector<scenario::Robot> robots_of(const WalkOptions& options, const model::World* world) {
  const std::vector<Seat> seats =
      world != nullptr ? seats_of_world(options, *world) : seats_of(options.command, options.team);
  check_model(options, seats, world);
  if (seats.empty()) return {robot_of(options)};
  require_alone(options);
  std::vector<scenario::Robot> robots;
  for (const Seat& seat : seats) {
    robots.push_back(robot_of(options, seat, robots.size()));
    if (world == nullptr) continue;
    const model::WorldRobot& put = world->robots[robots.size() - 1];
    robots.back().at = {put.x_m, put.y_m, put.yaw_rad};
  }
  return robots;
}

}  // namespace

Scenario scenario_of(const WalkOptions& options, const sim::WorldOptions& world) {
  const bool of_world = world.scenery != nullptr && !world.scenery->robots.empty();
  Scenario scenario{.world = world_of(options),
                    .robots = robots_of(options, of_world ? world.scenery.get() : nullptr),
                    .radio = {},
                    .length_s = options.walk_s,
                    .real_time = options.real_time,
                    .if_lost_go_on = options.team.go_on,
                    .patience_s = options.team.patience_s};
  place_robots(options.place, scenario.robots);
  if (options.radio) scenario.radio = {radio_of(options.command, *options.radio), options.seed};
  const auto first = std::find_if(scenario.robots.begin(), scenario.robots.end(),
                                  [](const auto& each) { return each.controller.link.empty(); });
  scenario::Robot& disturbed = first == scenario.robots.end() ? scenario.robots.front() : *first;
  disturbed.disturbances = disturbances_of(options.touch);
  disturbed.fault = options.fault;
  return scenario;
}

scenario::Expanded expand(const WalkOptions& options, const Scenario& scenario,
                          const sim::WorldOptions& world) {
  const std::string& file = options.scenario_file;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    check_board(scenario.robots[i].controller.board,
                file.empty() ? "verp walk: --on"
                             : fmt::format("{}: robots[{}].controller.board:", file, i));
  }
  try {
    return scenario::expand(scenario, world);
  } catch (const model::LoadError& error) {
    if (file.empty()) throw;
    throw cli::ToolError(cli::kBadInput, fmt::format("{}: {}", file, error.what()));
  } catch (const scenario::ScenarioError& error) {
    throw cli::ToolError(cli::kBadInput, in_words(options, scenario, error));
  }
}

Walk walk_of(const WalkOptions& options) {
  Walk walk;
  const bool of_file = !options.scenario_file.empty();
  refuse_beside_scenario(options);
  if (of_file) walk.scenario = scenario::read(options.scenario_file);
  walk.scenario.real_time = walk.scenario.real_time || options.real_time;
  const sim::WorldOptions world =
      scenario::world_of(of_file ? walk.scenario.world : world_of(options));
  if (!of_file) walk.scenario = scenario_of(options, world);
  walk.run = expand(options, walk.scenario, world);
  for (session::WalkPlan& plan : walk.run.plans) {
    if (plan.get_ups > 0) action::take_get_up_actions(plan);
    if (plan.link.empty()) action::take_lie_down(plan);  // else its controller has its own
  }
  return walk;
}

Drawn drawn_of(const Walk& walk) {
  Drawn drawn;
  drawn.json["physics_step_ms"] = walk.scenario.world.physics_step_ms;
  if (walk.run.drawn.empty()) return drawn;
  drawn.text = fmt::format("varied by seed {}:\n", walk.run.plans.front().twin.seed);
  for (const auto& [name, value] : walk.run.drawn) {
    drawn.json["varied"][name] = value;
    drawn.text += fmt::format("  {:<24} {:.4g}\n", name, value);
  }
  return drawn;
}

record::mcap::StringMap metadata_of(const WalkOptions& options, const session::WalkPlan& plan,
                                    const Scenario& scenario) {
  record::mcap::StringMap all = scenario::metadata_of(plan, scenario);
  std::string& changed = all["changed"];
  for (const auto& [name, value] : options.changed)
    changed += (changed.empty() ? "" : " ") + name + (value.empty() ? "" : " " + value);
  return all;
}

}  // namespace verp::tool
