#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/run/scenario/scenario.hpp"
#include "host/run/session/plan.hpp"
#include "host/trace/record/mcap_format.hpp"
#include "host/twin/sim/world.hpp"

/// From a Scenario to what a session takes.
namespace verp::scenario {

/// A value of a Scenario that makes no run. `where` is its path, such as "robots[0].tuning".
class ScenarioError : public std::invalid_argument {
 public:
  ScenarioError(std::string path, const std::string& what, std::vector<std::string> names = {})
      : std::invalid_argument(what), where(std::move(path)), known(std::move(names)) {}

  const std::string where;
  const std::vector<std::string> known;  ///< names that would have been understood
};

/// A Scenario with its files loaded: a session needs no more than this.
struct Expanded {
  sim::WorldOptions world = {};
  /// Robots whose controllers are outside come last: report and pictures are of the first one.
  std::vector<session::WalkPlan> plans = {};
  /// What Robot::vary drew for the first robot and for the floor.
  std::vector<std::pair<std::string, double>> drawn = {};
};

/// Loads world and robots, checks the disturbances against them, draws what varies. A robot that
/// may get up (WalkPlan::get_ups) still needs its actions: host/author/action/get_up.hpp. Throws
/// ScenarioError and model::LoadError.
Expanded expand(const Scenario& scenario);
/// The same in a world that was loaded already.
Expanded expand(const Scenario& scenario, const sim::WorldOptions& world);

/// The parts of it, for callers that have loaded a robot by themselves or have only one.
sim::WorldOptions world_of(const World& world);
session::WalkPlan plan_of(const Robot& robot, double length_s);
session::WalkPlan plan_of(const Robot& robot, double length_s, model::Entity entity);

/// What the orders come to with this gait, in the units of the controller.
Command velocity_of(const Orders& orders, const GaitTuning& gait);
/// Gives the plan, whose Params are there, the orders, or as much of them as its servos can follow.
void give_orders(const Orders& orders, session::WalkPlan& plan);
/// Throws std::out_of_range for a name that the tuning does not have.
void tune(const std::map<std::string, double>& values, Tuning& tuning);

/// Metadata of a trace: the robot of this plan, and, with a scenario, the walk.
record::mcap::StringMap metadata_of(const session::WalkPlan& plan);
record::mcap::StringMap metadata_of(const session::WalkPlan& plan, const Scenario& scenario);
/// "0.1,0,0.2"; empty: these orders are none by velocity.
std::string velocity_text(const Orders& orders);

}  // namespace verp::scenario
