#pragma once
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/run/scenario/scenario.hpp"
#include "host/twin/sim/scenery.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// Options for where the robot walks: --world, --at-pose.
struct PlaceOptions {
  std::string world;
  std::vector<std::string> poses;  ///< X,Y,YAW; among several robots NAME=X,Y,YAW
};

void declare(CLI::App& app, PlaceOptions& options);

/// Puts robots to their --at-pose; one that stands alone needs no name there. Throws ToolError.
void place_robots(const PlaceOptions& options, std::vector<scenario::Robot>& robots);

/// Of the world that can be pushed or move, and where it ended.
cli::Json objects_of(const sim::Scenery& scenery);

}  // namespace verp::tool
