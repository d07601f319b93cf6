#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/apps/cli/progress.hpp"
#include "host/run/session/plan.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// --controller.
void declare_controller(CLI::App& app, std::string& folder);

/// Builds the controller in that folder for this PC. The result makes one controller per run.
/// Throws ToolError, with the compiler's messages if it does not compile.
std::function<session::Decide()> own_controller(const std::string& folder, bool show);

/// Builds a firmware target of the board with it; returns the folder of its images.
std::string build_firmware_of(const std::string& folder, const std::string& board,
                              const std::string& target, cli::Progress& progress);

/// Has it decide for every robot that is driven from here, or by an emulated board. An empty
/// `folder` changes nothing.
void take_controller(const std::string& folder, std::vector<session::WalkPlan>& plans, bool show);

}  // namespace verp::tool
