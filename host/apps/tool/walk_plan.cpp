#include "host/apps/tool/walk_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/apps/cli/exit_status.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/stance.hpp"
#include "host/run/session/stride.hpp"
#include "host/twin/sim/vary.hpp"

namespace verp::tool {

using session::WalkPlan;

void ask_for_walk(const WalkOptions& options, WalkPlan& plan) {
  const Command asked = velocity_of(options, plan.params.tuning.gait, options.step_m);
  const session::Followed followed = session::within_servo_speed(plan.params, asked);
  plan.asked = asked;
  plan.velocity = followed.velocity;
  plan.remark = followed.remark;
  plan.walk_s = options.walk_s;
  plan.stands = options.stand;
}

sim::Lies lies_of(const WalkOptions& options) {
  constexpr std::pair<const char*, sim::Lies> kStarts[] = {
      {"standing", sim::Lies::kNo},       {"lying:front", sim::Lies::kFront},
      {"lying:back", sim::Lies::kBack},   {"lying:left", sim::Lies::kLeft},
      {"lying:right", sim::Lies::kRight}, {"lying:any", sim::Lies::kAny}};
  for (const auto& [name, lies] : kStarts) {
    if (options.start == name) return lies;
  }
  return sim::Lies::kNo;
}

void prepare_falls(const WalkOptions& options, WalkPlan& plan) {
  plan.twin.lies = lies_of(options);
  if (!options.get_up && plan.twin.lies == sim::Lies::kNo) return;
  if (!options.controller.empty()) {
    throw cli::ToolError(
        cli::kBadInput,
        "verp walk --controller: one of your own is given no actions to get up by; "
        "leave --get-up and --start out");
  }
  take_get_up_actions(plan);
}

WalkPlan make_plan(const WalkOptions& options) {
  check_board(options);
  WalkPlan plan;
  plan.entity = model::load_robot(model::find_model(options.model), options.bus);
  if (!options.board.empty()) require_serial("verp walk --on", plan.entity);
  plan.params = model::make_params(plan.entity);
  apply_tuning(options, plan.params.tuning);
  if (!options.settings.empty() && !model::can_stand(plan.params)) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("{}: --set: the legs cannot stand level with the hip {:.3f} m above "
                    "the ankle and {:.3f} m beside the middle; choose gait.hip_height_m "
                    "near {:.3f}",
                    options.command, plan.params.tuning.gait.hip_height_m,
                    plan.params.tuning.gait.half_stance_m,
                    model::make_params(plan.entity).tuning.gait.hip_height_m));
  }
  ask_for_walk(options, plan);
  plan.twin.seed = options.seed;
  plan.board = options.board;
  prepare_falls(options, plan);
  return plan;
}

namespace {

/// A served robot gets so much longer than its walk, to rise before and to sit down after.
constexpr double kBeforeAndAfter_s = 10;
/// And so much if it may get up: what all tries take together.
constexpr double kGetUps_s = 60;

void require_alone(const WalkOptions& options, const std::string& why) {
  if (options.board.empty()) return;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("{}: {}; say whose controller runs on the board: --robot NAME=on:{}",
                  options.command, why, options.board));
}

WalkPlan plan_of(const WalkOptions& options, const Seat& seat, std::size_t index) {
  WalkOptions own = options;
  if (!seat.model.empty()) own.model = seat.model;
  own.board = seat.board;
  own.seed = options.seed + index;
  WalkPlan plan = make_plan(own);
  plan.name = seat.name;
  plan.link = seat.link;
  if (!seat.link.empty()) {
    plan.walk_s += kBeforeAndAfter_s + (plan.get_ups > 0 ? kGetUps_s : 0);
  }
  return plan;
}

/// Of the robots that the world has of its own, who drives them; those that are not named have it
/// as it is.
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

/// Those with controllers in this program first: of the first one are report and pictures.
void put_outside_last(std::vector<WalkPlan>& plans) {
  std::stable_partition(plans.begin(), plans.end(),
                        [](const WalkPlan& plan) { return plan.link.empty(); });
}

}  // namespace

std::vector<WalkPlan> make_plans(const WalkOptions& options, const sim::WorldOptions& world) {
  const bool of_world = world.scenery != nullptr && !world.scenery->robots.empty();
  if (of_world && options.model_given) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: {} has robots of its own; leave MODEL out, or take "
                                     "its <include>s out",
                                     options.command, world.scenery->file));
  }
  const std::vector<Seat> seats =
      of_world ? seats_of_world(options, *world.scenery) : seats_of(options.command, options.team);
  const bool of_nobody =
      !seats.empty() &&
      std::none_of(seats.begin(), seats.end(), [](const Seat& seat) { return seat.model.empty(); });
  if (options.model_given && of_nobody) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("{0}: {1} has no name, and each robot that has one has a model of its own; add "
                    "--robot NAME={1}, or leave it out (names have letters, digits, _ and -)",
                    options.command, options.model));
  }
  std::vector<WalkPlan> plans;
  if (seats.empty()) plans.push_back(make_plan(options));
  if (!seats.empty()) require_alone(options, "several robots");
  for (const Seat& seat : seats) {
    const std::size_t index = plans.size();
    WalkPlan plan = plan_of(options, seat, index);
    plan.twin.start_m.head<2>() = place_in_column(index);
    if (of_world) {
      const model::WorldRobot& robot = world.scenery->robots[index];
      plan.twin.start_m = {robot.x_m, robot.y_m, 0};
      plan.twin.start_yaw_rad = robot.yaw_rad;
    }
    plans.push_back(std::move(plan));
  }
  place_robots(options.place, plans);
  put_outside_last(plans);
  return plans;
}

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

}  // namespace verp::tool
