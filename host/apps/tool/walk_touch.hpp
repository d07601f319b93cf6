#pragma once
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/run/scenario/expand.hpp"

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

/// What they ask for: pushes first. Throws ToolError.
std::vector<session::Intervention> disturbances_of(const TouchOptions& options);
/// The words that gave the one of that index: "--push '1: body 0,30,0 N for 0.1'".
std::string option_of(const TouchOptions& options, std::size_t index);

/// All quantities of a run: for people one line for each kind.
int list_quantities(const scenario::Expanded& run, bool json);

/// What was done when; empty if nothing was.
cli::Json touch_json(const WalkResult& result);
std::string touch_text(const WalkResult& result);
/// One line for each intervention that the run was too short for.
std::vector<std::string> never_done(const WalkPlan& plan, const WalkResult& result);

}  // namespace verp::tool
