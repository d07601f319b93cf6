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

/// Options for the user's interventions in a walk: --push, --at, --list-quantities.
struct TouchOptions {
  std::vector<std::string> pushes, settings;
  bool list = false;
  std::string command = "verp walk";  ///< for messages
};

void declare(CLI::App& app, TouchOptions& options);
/// Declares only --push.
void declare_push(CLI::App& app, TouchOptions& options);

/// The interventions of the options, pushes first. Throws ToolError.
std::vector<session::Intervention> disturbances_of(const TouchOptions& options);
/// The option of the intervention with this index: "--push '1: body 0,30,0 N for 0.1'".
std::string option_of(const TouchOptions& options, std::size_t index);

/// Prints the quantities of a run: all as JSON, or one line per kind as text.
int list_quantities(const scenario::Expanded& run, bool json);

/// Interventions and their times; empty without any.
cli::Json touch_json(const WalkResult& result);
std::string touch_text(const WalkResult& result);
/// One line for each intervention after the end of the run.
std::vector<std::string> never_done(const WalkPlan& plan, const WalkResult& result);

}  // namespace verp::tool
