#pragma once
#include <string>
#include <utility>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/run/scenario/expand.hpp"

/// From the command line of `verp walk` to a Scenario. Errors name the option that is wrong.
namespace verp::tool {

/// The robot of MODEL. Throws ToolError.
scenario::Robot robot_of(const WalkOptions& options);
scenario::World world_of(const WalkOptions& options);
sim::Lies lies_of(const WalkOptions& options);

/// A run, and the plans from its files.
struct Walk {
  scenario::Scenario scenario;
  scenario::Expanded run;
};

/// The run of the options or of --scenario. The options give one robot, or the robots of --robots,
/// of --robot NAME=... and of the world. Each next robot's seed is one more. Throws ToolError and
/// LoadError.
Walk walk_of(const WalkOptions& options);
scenario::Scenario scenario_of(const WalkOptions& options, const sim::WorldOptions& world);

/// scenario::expand(); its errors name the options.
scenario::Expanded expand(const WalkOptions& options, const scenario::Scenario& scenario,
                          const sim::WorldOptions& world);

/// Values that --vary drew, as text and for --json.
struct Drawn {
  cli::Json json = cli::Json::object();
  std::string text;
};
Drawn drawn_of(const Walk& walk);

/// Metadata of a robot's trace, with the options.
record::mcap::StringMap metadata_of(const WalkOptions& options, const session::WalkPlan& plan,
                                    const scenario::Scenario& scenario);

}  // namespace verp::tool
