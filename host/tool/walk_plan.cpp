#include "host/tool/walk_plan.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/action/compile.hpp"
#include "host/action/folder.hpp"
#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"
#include "host/session/stride.hpp"
#include "host/sim/vary.hpp"
#include "host/tool/exit_status.hpp"

namespace verp::tool {

using session::WalkPlan;

void ask_for_walk(const WalkOptions& options, WalkPlan& plan) {
  const session::Followed followed =
      session::within_servo_speed(plan.params, velocity_of(options, options.step_m));
  plan.velocity = followed.velocity;
  plan.remark = followed.remark;
  plan.walk_s = options.walk_s;
}

namespace {

/// The robot's actions, if it is to get up, and how it is put down.
void prepare_falls(const WalkOptions& options, WalkPlan& plan) {
  constexpr int kTries = 3;
  constexpr std::pair<const char*, sim::Lies> kStarts[] = {
      {"standing", sim::Lies::kNo},       {"lying:front", sim::Lies::kFront},
      {"lying:back", sim::Lies::kBack},   {"lying:left", sim::Lies::kLeft},
      {"lying:right", sim::Lies::kRight}, {"lying:any", sim::Lies::kAny}};
  for (const auto& [name, lies] : kStarts) {
    if (options.start == name) plan.twin.lies = lies;
  }
  if (!options.get_up && plan.twin.lies == sim::Lies::kNo) return;
  if (!options.board.empty()) {
    throw ToolError(kBadInput,
                    "verp walk --on: the board's firmware has no actions to get up by; leave "
                    "--get-up and --start out");
  }
  const auto folder = action::folder_of(plan.entity.file);
  const action::Made made = action::make_library(plan.params, action::read_folder(folder));
  made.require(action::kGetUpFront, folder.string());
  made.require(action::kGetUpBack, folder.string());
  plan.actions = made.words;
  plan.get_ups = kTries;
}

}  // namespace

WalkPlan make_plan(const WalkOptions& options) {
  check_board(options);
  WalkPlan plan;
  plan.entity = model::load_robot(model::find_model(options.model), options.bus);
  if (!options.board.empty()) require_serial("verp walk --on", plan.entity);
  plan.params = model::make_params(plan.entity);
  apply_tuning(options, plan.params.tuning);
  ask_for_walk(options, plan);
  plan.twin.seed = options.seed;
  plan.board = options.board;
  prepare_falls(options, plan);
  return plan;
}

std::vector<WalkPlan> make_plans(const WalkOptions& options, const sim::WorldOptions& world) {
  if (world.scenery == nullptr || world.scenery->robots.empty()) {
    WalkPlan plan = make_plan(options);
    place_robot(options.place, plan);
    return {plan};
  }
  const std::vector<model::WorldRobot>& robots = world.scenery->robots;
  if (options.model_given || !options.place.pose_text.empty() || !options.board.empty()) {
    throw ToolError(kBadInput,
                    fmt::format("verp walk: {} has robots of its own; leave MODEL, --at-pose and "
                                "--on out, or take its <include>s out",
                                world.scenery->file));
  }
  std::vector<WalkPlan> plans;
  for (const model::WorldRobot& robot : robots) {
    WalkOptions own = options;
    own.model = robot.file;
    own.seed = options.seed + plans.size();
    WalkPlan plan = make_plan(own);
    plan.name = robot.name;
    plan.twin.start_m = {robot.x_m, robot.y_m, 0};
    plan.twin.start_yaw_rad = robot.yaw_rad;
    plans.push_back(std::move(plan));
  }
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
