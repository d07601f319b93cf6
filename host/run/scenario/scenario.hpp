#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "host/run/session/intervention.hpp"
#include "host/twin/radio/radio.hpp"
#include "host/twin/sim/robot.hpp"

/// One run as plain data: a world, its robots and its length.
///
///     scenario::Scenario scenario;  // generic21 walks 20 s on a level floor
///     scenario.robots[0].orders = scenario::Velocity{0.1, 0, 0.2};
///     const scenario::Expanded run = scenario::expand(scenario);  // expand.hpp: loads the files
///     session::walk(run.plans[0], {}, {.world = run.world});
///
/// Defaults are those of `verp walk`. text.hpp reads and prints a Scenario as JSON.
namespace verp::scenario {

inline constexpr std::size_t kMostRobots = 16;
inline constexpr std::uint64_t kMostSeed = 4294967295;

struct World {
  std::string file;  ///< name in common/worlds or an SDF file; empty: level floor
  double physics_step_ms = 1;

  bool operator==(const World&) const = default;
};

/// Straight ahead, by two steps of this length per cycle.
struct Ahead {
  double step_m = 0.04;
  bool operator==(const Ahead&) const = default;
};
struct Velocity {
  double vx_m_s = 0, vy_m_s = 0, wz_rad_s = 0;
  bool operator==(const Velocity&) const = default;
};
/// The robot steps only when pushed.
struct Stand {
  bool operator==(const Stand&) const = default;
};
using Orders = std::variant<Ahead, Velocity, Stand>;

/// Computes the ticks; all empty: the core, in this process.
struct Controller {
  std::string folder;  ///< the user's own (`verp new controller`)
  std::string board;   ///< emulated board that runs it
  std::string link;    ///< link to a controller elsewhere, in lockstep

  bool operator==(const Controller&) const = default;
};

struct Place {
  double x_m = 0, y_m = 0, yaw_rad = 0;  ///< in the world
  bool operator==(const Place&) const = default;
};

struct Robot {
  std::string name;                      ///< empty: the model's
  std::string model = "generic21";       ///< name in common/robots or an SDF file
  std::string bus;                       ///< empty: the model's first
  std::map<std::string, double> tuning;  ///< `verp parameters` lists the names
  Orders orders;
  Controller controller;
  std::uint64_t seed = 1;  ///< for all randomness of this robot
  bool vary = false;       ///< domain randomization by the seed (sim/vary.hpp)
  Place at;
  sim::Lies lies = sim::Lies::kNo;  ///< pose at the start
  bool get_up = false;              ///< a fall does not end its run
  std::vector<session::Intervention> disturbances;
  std::string fault;  ///< a field bug (field_bugs.hpp); empty: none

  bool operator==(const Robot&) const = default;
};

/// Its stations are Scenario::robots, in order.
struct Radio {
  radio::Conditions conditions;
  std::uint64_t seed = 1;

  bool operator==(const Radio&) const = default;
};

struct Scenario {
  World world;
  std::vector<Robot> robots{Robot{}};
  std::optional<Radio> radio;
  double length_s = 20;  ///< all three phases of the gait
  bool real_time = false;
  bool if_lost_go_on = false;  ///< a lost controller ends only its robot's run
  double patience_s = 10;      ///< the world waits so long for a controller on a link

  bool operator==(const Scenario&) const = default;
};

}  // namespace verp::scenario
