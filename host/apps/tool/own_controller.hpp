#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/apps/cli/progress.hpp"
#include "host/run/scenario/scenario.hpp"
#include "host/run/session/plan.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// Declares --controller.
void declare_controller(CLI::App& app, std::string& folder);

/// Builds the folder's controller for this PC. One controller per run. Throws ToolError with the
/// compiler's messages.
std::function<session::Decide()> own_controller(const std::string& folder, bool show);

/// Builds a firmware target with the controller; returns the images' folder.
std::string build_firmware_of(const std::string& folder, const std::string& board,
                              const std::string& target, cli::Progress& progress);

/// Builds each robot's own controller and puts it into the plan.
void take_controllers(const scenario::Scenario& scenario, std::vector<session::WalkPlan>& plans,
                      bool show);

}  // namespace verp::tool
