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

struct TouchOptions {
  std::vector<std::string> pushes, settings;
  bool list = false;
  std::string command = "verp walk";  ///< for messages
};

void declare(CLI::App& app, TouchOptions& options);
void declare_push(CLI::App& app, TouchOptions& options);

/// The interventions of the options, pushes first. Throws ToolError.
std::vector<session::Intervention> disturbances_of(const TouchOptions& options);
/// The option as text, for example "--push '1: body 0,30,0 N for 0.1'".
std::string option_of(const TouchOptions& options, std::size_t index);

/// Prints all quantities as JSON, or one line per kind.
int list_quantities(const scenario::Expanded& run, bool json);

cli::Json touch_json(const WalkResult& result);
std::string touch_text(const WalkResult& result);
/// One line per intervention after the run's end.
std::vector<std::string> never_done(const WalkPlan& plan, const WalkResult& result);

}  // namespace verp::tool
