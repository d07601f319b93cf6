#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/twin/sim/truth.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// Several robots in one world: --robots, --robot NAME=..., and what becomes of the others when one
/// has lost its controller.
struct TeamOptions {
  int robots = 0;  ///< so many of MODEL; 0: as few as are named
  /// NAME=MODEL, NAME=ext:LINK, NAME=on:BOARD, or with MODEL before: NAME=MODEL,ext:LINK.
  std::vector<std::string> seats;
  bool go_on = false;      ///< without the one that has lost its controller
  double patience_s = 10;  ///< with a controller outside, by the wall's clock
  std::string of_outside;  ///< an option that was given and is of those alone; empty: none
};

/// --robots alone: for commands whose robots have their controllers in this process.
void declare_robots(CLI::App& app, TeamOptions& options);
/// What is said of controllers outside.
void declare_outside(CLI::App& app, TeamOptions& options);
/// --radio, with words or without.
void declare_radio(CLI::App& app, std::optional<std::string>& radio);

/// Of what was given to MODEL and --robot: robots with a name of their own (NAME=...) go to
/// `seats`, the one that is left is the model. Returns whether there was one. Throws ToolError if
/// there were two.
bool sort_robot_words(const std::vector<std::string>& words, std::string& model,
                      std::vector<std::string>& seats);

/// One robot among others, and who drives it.
struct Seat {
  std::string name;
  std::string model;  ///< empty: MODEL
  std::string link;   ///< its controller is at the other end; empty: it is not
  std::string board;  ///< emulated board that runs its controller; empty: none
};

/// Those of --robots (r1, r2, ...), of which --robot NAME=... may say who drives them, and those of
/// --robot that bring a name of their own. Throws ToolError.
std::vector<Seat> seats_of(const std::string& command, const TeamOptions& options);

/// Where the robot of this number stands, if nobody says so: two abreast, looking along x, rows far
/// enough apart for what a walk drifts (2 % of the way, and 0.4 m for arms).
sim::Vec2 place_in_column(std::size_t index);

}  // namespace verp::tool
