#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/twin/sim/truth.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

struct TeamOptions {
  int robots = 0;  ///< 0: only named ones
  /// NAME=MODEL, NAME=ext:LINK, NAME=on:BOARD, or with a model NAME=MODEL,ext:LINK.
  std::vector<std::string> seats;
  bool go_on = false;      ///< a lost controller ends only its robot's run
  double patience_s = 10;  ///< for a controller elsewhere, wall clock
  std::string of_outside;  ///< the given option for controllers elsewhere
};

/// Declares only --robots, for commands with local controllers.
void declare_robots(CLI::App& app, TeamOptions& options);
void declare_outside(CLI::App& app, TeamOptions& options);
void declare_radio(CLI::App& app, std::optional<std::string>& radio);

/// Values of MODEL and --robot: NAME=... goes to `seats`, another value is the model. True: there
/// is a model. Throws ToolError for two models.
bool sort_robot_words(const std::vector<std::string>& words, std::string& model,
                      std::vector<std::string>& seats);

struct Seat {
  std::string name;
  std::string model;  ///< empty: MODEL
  std::string link;   ///< to a controller elsewhere; empty: none
  std::string board;  ///< emulated board that runs its controller; empty: none
};

/// --robots (r1, r2, ...) and --robot NAME=..., which may also set the controller of one of the
/// former. Throws ToolError.
std::vector<Seat> seats_of(const std::string& command, const TeamOptions& options);

/// Two abreast, heading along x. The spacing allows 2 % drift and arms (0.4 m).
sim::Vec2 place_in_column(std::size_t index);

}  // namespace verp::tool
