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

/// The controller in that folder, built for this PC: makes one for each run. Throws ToolError, with
/// the compiler's words if it does not compile.
std::function<session::Decide()> own_controller(const std::string& folder, bool show);

/// Builds a target of the board's firmware with it: the folder of its images.
std::string build_firmware_of(const std::string& folder, const std::string& board,
                              const std::string& target, cli::Progress& progress);

/// Has it decide for every robot that is driven from here, or by an emulated board. An empty
/// `folder` changes nothing.
void take_controller(const std::string& folder, std::vector<session::WalkPlan>& plans, bool show);

}  // namespace verp::tool
