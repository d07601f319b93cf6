#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/twin/sim/truth.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// Several robots in one world: --robots, --robot NAME=..., and the effect of a lost controller on
/// the other robots.
struct TeamOptions {
  int robots = 0;  ///< number of MODEL robots; 0: only named robots
  /// NAME=MODEL, NAME=ext:LINK, NAME=on:BOARD, or with a model NAME=MODEL,ext:LINK.
  std::vector<std::string> seats;
  bool go_on = false;      ///< a lost controller ends only its robot's run
  double patience_s = 10;  ///< with a controller elsewhere, by the wall clock
  std::string of_outside;  ///< given option for controllers elsewhere; empty: none
};

/// Declares only --robots, for commands with local controllers.
void declare_robots(CLI::App& app, TeamOptions& options);
/// Declares the options for controllers elsewhere.
void declare_outside(CLI::App& app, TeamOptions& options);
/// Declares --radio, with an optional value.
void declare_radio(CLI::App& app, std::optional<std::string>& radio);

/// Sorts the values of MODEL and --robot: named robots (NAME=...) go to `seats`, another value is
/// the model. True: there is a model. Throws ToolError for two models.
bool sort_robot_words(const std::vector<std::string>& words, std::string& model,
                      std::vector<std::string>& seats);

/// One of several robots, and its controller.
struct Seat {
  std::string name;
  std::string model;  ///< empty: MODEL
  std::string link;   ///< to a controller elsewhere; empty: none
  std::string board;  ///< emulated board that runs its controller; empty: none
};

/// The robots of --robots (r1, r2, ...) and of --robot NAME=... . The latter option may also set
/// the controller of a robot of the former. Throws ToolError.
std::vector<Seat> seats_of(const std::string& command, const TeamOptions& options);

/// Default start place of a robot: two abreast, heading along x. The spacing allows for the drift
/// of a walk (2 % of the way) and for arms (0.4 m).
sim::Vec2 place_in_column(std::size_t index);

}  // namespace verp::tool
