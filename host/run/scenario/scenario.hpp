#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "host/run/session/intervention.hpp"
#include "host/twin/radio/radio.hpp"
#include "host/twin/sim/robot.hpp"

/// One run as plain data: a world, the robots in it, and how long it lasts. The command line, the
/// window, the library, the demos and the tests all describe a run by a Scenario.
///
///     scenario::Scenario scenario;  // generic21 walks 20 s on a level floor
///     scenario.robots[0].orders = scenario::Velocity{0.1, 0, 0.2};
///     const scenario::Expanded run = scenario::expand(scenario);  // expand.hpp: loads the files
///     session::walk(run.plans[0], {}, {.world = run.world});
///
/// The defaults are those of `verp walk`. text.hpp reads and prints a Scenario as a JSON file.
namespace verp::scenario {

struct World {
  std::string file;  ///< a world of common/worlds, or an SDF file's path; empty: level floor
  double physics_step_ms = 1;

  bool operator==(const World&) const = default;
};

/// Straight ahead: two steps of this length in a cycle of the robot's gait.
struct Ahead {
  double step_m = 0.04;
  bool operator==(const Ahead&) const = default;
};
struct Velocity {
  double vx_m_s = 0, vy_m_s = 0, wz_rad_s = 0;
  bool operator==(const Velocity&) const = default;
};
/// It steps only where a push makes it step.
struct Stand {
  bool operator==(const Stand&) const = default;
};
/// The operator's order to a robot.
using Orders = std::variant<Ahead, Velocity, Stand>;

/// Computes the robot's ticks. All empty: the core, in this process.
struct Controller {
  std::string folder;  ///< the user's own controller (`verp new controller`)
  std::string board;   ///< the emulated board that runs it
  std::string link;    ///< link to a controller elsewhere, in lockstep

  bool operator==(const Controller&) const = default;
};

struct Place {
  double x_m = 0, y_m = 0, yaw_rad = 0;  ///< in the world
  bool operator==(const Place&) const = default;
};

struct Robot {
  std::string name;                 ///< distinguishes robots; empty: the model's name
  std::string model = "generic21";  ///< name of a robot in common/robots, or path of an SDF file
  std::string bus;                  ///< by name; empty: the model's first
  std::map<std::string, double> tuning;  ///< `verp parameters` lists the names
  Orders orders;
  Controller controller;
  std::uint64_t seed = 1;  ///< seeds all randomness of this robot
  bool vary = false;       ///< domain randomization: draws the robot from the seed (sim/vary.hpp)
  Place at;
  sim::Lies lies = sim::Lies::kNo;  ///< pose at the start
  bool get_up = false;              ///< a fall does not end its run
  std::vector<session::Intervention> disturbances;

  bool operator==(const Robot&) const = default;
};

/// The robots' radio. Its stations are Scenario::robots, in that order.
struct Radio {
  radio::Conditions conditions;
  std::uint64_t seed = 1;

  bool operator==(const Radio&) const = default;
};

struct Scenario {
  World world;
  std::vector<Robot> robots{Robot{}};
  std::optional<Radio> radio;
  double length_s = 20;        ///< length of the gait, all three phases
  bool real_time = false;      ///< no faster than the clock
  bool if_lost_go_on = false;  ///< losing a controller ends only that robot's run
  double patience_s = 10;      ///< the world waits this long for a controller on a link

  bool operator==(const Scenario&) const = default;
};

}  // namespace verp::scenario
