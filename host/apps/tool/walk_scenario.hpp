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

/// A run, and what its files hold.
struct Walk {
  scenario::Scenario scenario;
  scenario::Expanded run;
};

/// The run that the options mean: that robot alone, or those of --robots, --robot NAME=... and the
/// world, each with a seed of its own (the next one's is one more); or the run of --scenario.
/// Throws ToolError and LoadError.
Walk walk_of(const WalkOptions& options);
scenario::Scenario scenario_of(const WalkOptions& options, const sim::WorldOptions& world);

/// scenario::expand() of what the options gave.
scenario::Expanded expand(const WalkOptions& options, const scenario::Scenario& scenario,
                          const sim::WorldOptions& world);

/// What --vary drew, for people and for --json.
struct Drawn {
  cli::Json json = cli::Json::object();
  std::string text;
};
Drawn drawn_of(const Walk& walk);

/// Metadata of that robot's trace, with the options that were given.
record::mcap::StringMap metadata_of(const WalkOptions& options, const session::WalkPlan& plan,
                                    const scenario::Scenario& scenario);

}  // namespace verp::tool
