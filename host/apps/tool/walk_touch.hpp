#pragma once
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/twin/sim/world.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// Options for what a person does to the twin during a walk: --push, --at, --list-quantities.
struct TouchOptions {
  std::vector<std::string> pushes, settings;
  bool list = false;
  std::string command = "verp walk";  ///< for messages
};

void declare(CLI::App& app, TouchOptions& options);
/// Of these, --push alone.
void declare_push(CLI::App& app, TouchOptions& options);

/// Reads them into the plan, and checks them against the robots and the world that the run will
/// have. Throws ToolError.
void read_touch(const TouchOptions& options, WalkPlan& plan, const std::vector<WalkPlan>& others,
                const sim::WorldOptions& world);

/// All quantities of that robot in that world: for people one line for each kind.
int list_quantities(const WalkPlan& plan, const std::vector<WalkPlan>& others,
                    const sim::WorldOptions& world, bool json);

/// What was done when; empty if nothing was.
cli::Json touch_json(const WalkResult& result);
std::string touch_text(const WalkResult& result);
/// One line for each intervention that the run was too short for.
std::vector<std::string> never_done(const WalkPlan& plan, const WalkResult& result);

}  // namespace verp::tool
