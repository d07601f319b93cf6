#pragma once
#include <string>
#include <utility>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/run/scenario/expand.hpp"

namespace verp::tool {

/// Throws ToolError.
scenario::Robot robot_of(const WalkOptions& options);
scenario::World world_of(const WalkOptions& options);
sim::Lies lies_of(const WalkOptions& options);

struct Walk {
  scenario::Scenario scenario;
  scenario::Expanded run;
};

/// The run of the options or --scenario. Robots: MODEL, --robots, --robot NAME=... and the world's.
/// Each next seed is one more. Throws ToolError and LoadError.
Walk walk_of(const WalkOptions& options);
scenario::Scenario scenario_of(const WalkOptions& options, const sim::WorldOptions& world);

/// scenario::expand(); its errors name the options.
scenario::Expanded expand(const WalkOptions& options, const scenario::Scenario& scenario,
                          const sim::WorldOptions& world);

/// Values drawn by --vary, as text and for --json.
struct Drawn {
  cli::Json json = cli::Json::object();
  std::string text;
};
Drawn drawn_of(const Walk& walk);

record::mcap::StringMap metadata_of(const WalkOptions& options, const session::WalkPlan& plan,
                                    const scenario::Scenario& scenario);

}  // namespace verp::tool
