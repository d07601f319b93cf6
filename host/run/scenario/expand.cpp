#include "host/run/scenario/expand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/stance.hpp"
#include "host/run/scenario/field_bugs.hpp"
#include "host/run/scenario/probe.hpp"
#include "host/run/session/get_up.hpp"
#include "host/run/session/stride.hpp"
#include "host/twin/sim/scenery.hpp"
#include "host/twin/sim/vary.hpp"

namespace verp::scenario {
namespace {

namespace fs = std::filesystem;
using session::WalkPlan;

/// A robot at a link rises before its walk, and sits and lies down after.
constexpr double kBeforeAndAfter_s = 20;
constexpr double kGetUps_s = 60;

/// The decimal number behind a float: 0.06 for 0.06F.
double decimal(float value) {
  return std::stod(fmt::format("{:g}", value));
}

void require_stance(const Robot& robot, const WalkPlan& plan) {
  if (robot.tuning.empty() || model::can_stand(plan.params)) return;
  const GaitTuning& gait = plan.params.tuning.gait;
  throw ScenarioError(
      "tuning", fmt::format("the legs cannot stand level with the hip {:.3f} m above the ankle and "
                            "{:.3f} m beside the middle; choose gait.hip_height_m near {:.3f}",
                            gait.hip_height_m, gait.half_stance_m,
                            model::make_params(plan.entity).tuning.gait.hip_height_m));
}

void prepare_falls(const Robot& robot, WalkPlan& plan) {
  plan.twin.lies = robot.lies;
  if (!robot.get_up && robot.lies == sim::Lies::kNo) return;
  if (!robot.controller.folder.empty()) {
    throw ScenarioError("controller.folder", "one of your own is given no actions to get up by");
  }
  plan.get_ups = session::kGetUpTries;
}

/// Emulated boards have a serial servo bus.
void require_serial(const Robot& robot, const model::Entity& entity) {
  if (robot.controller.board.empty() || entity.protocol != BusProtocol::kCia402) return;
  throw ScenarioError("bus", fmt::format("bus '{}' of {} is CAN, and emulated boards have a serial "
                                         "servo bus; choose another of its buses",
                                         entity.bus, entity.name));
}

std::string path_of(int robot, const std::string& where) {
  return fmt::format("robots[{}].{}", robot, where);
}

/// Reads a file once for all its robots.
WalkPlan plan_after(const std::vector<WalkPlan>& plans, const Scenario& scenario) {
  const Robot& robot = scenario.robots[plans.size()];
  for (const WalkPlan& plan : plans) {
    const Robot& other = scenario.robots[static_cast<std::size_t>(plan.number)];
    if (other.model == robot.model && other.bus == robot.bus)
      return plan_of(robot, scenario.length_s, plan.entity);
  }
  return plan_of(robot, scenario.length_s);
}

std::vector<WalkPlan> plans_of(const Scenario& scenario) {
  std::vector<WalkPlan> plans;
  for (const Robot& robot : scenario.robots) {
    const int number = static_cast<int>(plans.size());
    try {
      plans.push_back(plan_after(plans, scenario));
      require_stance(robot, plans.back());
    } catch (const ScenarioError& error) {
      throw ScenarioError(path_of(number, error.where), error.what(), error.known);
    }
    plans.back().number = number;
  }
  std::stable_partition(plans.begin(), plans.end(),
                        [](const WalkPlan& plan) { return plan.link.empty(); });
  return plans;
}

void check_disturbances(const Expanded& run) {
  const auto none = [](const WalkPlan& plan) { return plan.interventions.empty(); };
  if (std::all_of(run.plans.begin(), run.plans.end(), none)) return;
  Probe probe(run);
  for (const WalkPlan& plan : run.plans) {
    for (std::size_t i = 0; i < plan.interventions.size(); ++i) {
      const session::Intervention& each = plan.interventions[i];
      const std::string where = path_of(plan.number, fmt::format("disturbances[{}]", i));
      try {
        session::check(each, probe.quantities);
      } catch (const std::invalid_argument& error) {
        const bool push = each.kind == session::Intervention::Kind::kPush;
        throw ScenarioError(where, error.what(),
                            push ? probe.quantities.things() : probe.quantities.names());
      }
      if (each.at_s <= plan.walk_s) continue;
      throw ScenarioError(where,
                          fmt::format("{:g} s is after the end, {:g} s", each.at_s, plan.walk_s));
    }
  }
}

void refuse_bugs(const Scenario& scenario) {
  for (const Robot& robot : scenario.robots) {
    if (robot.fault.empty()) continue;
    throw ScenarioError("fault", "a field bug is tried on one robot alone; leave out the others");
  }
}

/// The first robot's draws include the floor.
void vary(const Scenario& scenario, Expanded& run) {
  for (WalkPlan& plan : run.plans) {
    if (!scenario.robots[static_cast<std::size_t>(plan.number)].vary) continue;
    const bool first = &plan == &run.plans.front();
    sim::Varied varied = sim::vary(plan.entity, plan.twin, run.world);
    plan.entity = std::move(varied.entity);
    plan.twin = varied.twin;
    if (!first) continue;
    run.world = varied.world;
    run.drawn = std::move(varied.drawn);
  }
}

}  // namespace

Expanded expand(const Scenario& scenario) {
  return expand(scenario, world_of(scenario.world));
}

Expanded expand(const Scenario& scenario, const sim::WorldOptions& world) {
  if (scenario.robots.size() > 1) refuse_bugs(scenario);
  Expanded run{.world = world, .plans = plans_of(scenario), .drawn = {}};
  check_disturbances(run);
  vary(scenario, run);
  return run;
}

sim::WorldOptions world_of(const World& world) {
  sim::WorldOptions options;
  options.step_us = static_cast<std::uint32_t>(std::lround(1e3 * world.physics_step_ms));
  if (world.file.empty()) return options;
  return sim::furnished(options, model::load_world(model::find_world(world.file)));
}

WalkPlan plan_of(const Robot& robot, double length_s) {
  return plan_of(robot, length_s, model::load_robot(model::find_model(robot.model), robot.bus));
}

WalkPlan plan_of(const Robot& robot, double length_s, model::Entity entity) {
  require_serial(robot, entity);
  WalkPlan plan;
  plan.entity = std::move(entity);
  const FieldBug* bug = robot.fault.empty() ? nullptr : &field_bug(robot.fault);
  plan.params = bug != nullptr ? params_of(*bug, plan.entity) : model::make_params(plan.entity);
  tune(robot.tuning, plan.params.tuning);
  give_orders(robot.orders, plan);
  plan.name = robot.name;
  plan.walk_s = length_s;
  plan.twin.seed = robot.seed;
  plan.twin.start_m = {robot.at.x_m, robot.at.y_m, 0};
  plan.twin.start_yaw_rad = robot.at.yaw_rad;
  plan.board = robot.controller.board;
  plan.link = robot.controller.link;
  plan.interventions = robot.disturbances;
  prepare_falls(robot, plan);
  if (bug != nullptr) inject(*bug, plan);
  if (!plan.link.empty()) plan.walk_s += kBeforeAndAfter_s + (plan.get_ups > 0 ? kGetUps_s : 0);
  return plan;
}

Command velocity_of(const Orders& orders, const GaitTuning& gait) {
  Velocity asked;
  if (const auto* ahead = std::get_if<Ahead>(&orders))
    asked.vx_m_s = 2 * ahead->step_m / decimal(gait.cycle_s);
  if (const auto* velocity = std::get_if<Velocity>(&orders)) asked = *velocity;
  Command command;
  command.vx_tenth_mm_s = static_cast<std::int16_t>(std::lround(1e4 * asked.vx_m_s));
  command.vy_tenth_mm_s = static_cast<std::int16_t>(std::lround(1e4 * asked.vy_m_s));
  command.wz_mrad_s = static_cast<std::int16_t>(std::lround(1e3 * asked.wz_rad_s));
  return command;
}

double step_of(const Ahead& ahead, const GaitTuning& gait) {
  return ahead == Ahead{} ? std::min(ahead.step_m, decimal(gait.max_step_m)) : ahead.step_m;
}

void give_orders(const Orders& orders, WalkPlan& plan) {
  const GaitTuning& gait = plan.params.tuning.gait;
  const auto* ahead = std::get_if<Ahead>(&orders);
  plan.asked = velocity_of(ahead != nullptr ? Ahead{step_of(*ahead, gait)} : orders, gait);
  const session::FeasibleVelocity followed = session::within_servo_speed(plan.params, *plan.asked);
  plan.velocity = followed.velocity;
  plan.remark = followed.remark;
  plan.stands = std::holds_alternative<Stand>(orders);
}

void tune(const std::map<std::string, double>& values, Tuning& tuning) {
  for (const auto& [name, value] : values) {
    const auto id = model::tuning_id(name);
    if (!id) throw std::out_of_range("the tuning has no number " + name);
    const Range& range = kTuningRanges[*id];
    set_tuning_value(tuning, *id, std::clamp(static_cast<float>(value), range.low, range.high));
  }
}

std::string velocity_text(const Orders& orders) {
  const auto* velocity = std::get_if<Velocity>(&orders);
  if (velocity == nullptr) return "";
  return fmt::format("{},{},{}", velocity->vx_m_s, velocity->vy_m_s, velocity->wz_rad_s);
}

record::mcap::StringMap metadata_of(const WalkPlan& plan) {
  return {{"robot", plan.params.name},
          {"model_file", plan.entity.file},
          {"seed", std::to_string(plan.twin.seed)}};
}

record::mcap::StringMap metadata_of(const WalkPlan& plan, const Scenario& scenario) {
  const Robot& robot = scenario.robots[static_cast<std::size_t>(plan.number)];
  const std::string& world = scenario.world.file;
  const auto* ahead = std::get_if<Ahead>(&robot.orders);
  record::mcap::StringMap all = metadata_of(plan);
  all.merge(record::mcap::StringMap{
      // An absolute path works from any folder.
      {"world_file", fs::is_regular_file(world) ? fs::absolute(world).string() : world},
      {"step_m", fmt::format("{}", ahead != nullptr ? ahead->step_m : Ahead{}.step_m)},
      {"cycle_s", fmt::format("{}", plan.params.tuning.gait.cycle_s)},
      {"velocity", velocity_text(robot.orders)},
      {"walk_s", fmt::format("{}", scenario.length_s)},
      {"own_controller", robot.controller.folder.empty()
                             ? ""
                             : fs::weakly_canonical(robot.controller.folder).string()},
      {"controller", plan.board.empty() ? "this PC" : plan.board}});
  return all;
}

}  // namespace verp::scenario
