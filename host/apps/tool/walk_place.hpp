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

struct PlaceOptions {
  std::string world;
  std::vector<std::string> poses;  ///< with several robots NAME=X,Y,YAW
};

void declare(CLI::App& app, PlaceOptions& options);

/// A single robot needs no name. Throws ToolError.
void place_robots(const PlaceOptions& options, std::vector<scenario::Robot>& robots);

/// The world's movable objects and their end positions.
cli::Json objects_of(const sim::Scenery& scenery);

}  // namespace verp::tool
