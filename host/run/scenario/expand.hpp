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

namespace verp::scenario {

/// An invalid value; `where` is its path, such as "robots[0].tuning".
class ScenarioError : public std::invalid_argument {
 public:
  ScenarioError(std::string path, const std::string& what, std::vector<std::string> names = {})
      : std::invalid_argument(what), where(std::move(path)), known(std::move(names)) {}

  const std::string where;
  const std::vector<std::string> known;  ///< valid names
};

/// A Scenario with its files loaded.
struct Expanded {
  sim::WorldOptions world = {};
  /// Robots with a controller elsewhere come last. Reports show the first robot.
  std::vector<session::WalkPlan> plans = {};
  /// Drawn by Robot::vary, for the first robot and the floor.
  std::vector<std::pair<std::string, double>> drawn = {};
};

/// Loads world and robots, checks disturbances, draws random robots. Robots that may get up
/// (WalkPlan::get_ups) still need their actions: host/author/action/get_up.hpp. Throws
/// ScenarioError and model::LoadError.
Expanded expand(const Scenario& scenario);
/// The same in a loaded world.
Expanded expand(const Scenario& scenario, const sim::WorldOptions& world);

/// Parts of expand(), for callers that load a robot themselves or have only one.
sim::WorldOptions world_of(const World& world);
session::WalkPlan plan_of(const Robot& robot, double length_s);
session::WalkPlan plan_of(const Robot& robot, double length_s, model::Entity entity);

/// Velocity in the controller's units, for this gait.
Command velocity_of(const Orders& orders, const GaitTuning& gait);
/// Of a step that nobody chose (Ahead{}): at most gait.max_step_m.
double step_of(const Ahead& ahead, const GaitTuning& gait);
/// Writes the orders into the plan, reduced to what the servos can follow; needs plan.params.
void give_orders(const Orders& orders, session::WalkPlan& plan);
/// Throws std::out_of_range for an unknown name.
void tune(const std::map<std::string, double>& values, Tuning& tuning);

/// Metadata for a trace: the plan's robot, and with a scenario the walk.
record::mcap::StringMap metadata_of(const session::WalkPlan& plan);
record::mcap::StringMap metadata_of(const session::WalkPlan& plan, const Scenario& scenario);
/// "0.1,0,0.2"; empty if the orders are not a velocity.
std::string velocity_text(const Orders& orders);

}  // namespace verp::scenario
