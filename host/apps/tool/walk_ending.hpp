#pragma once
#include <string>

#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_report.hpp"
#include "host/apps/tool/walk_sweep.hpp"

namespace verp::tool {

/// Ends a command that walked: writes the files, answers in text or JSON, reports a failure, and
/// returns the exit status. `more` and `more_text`: further results of the command.
int finish_walk(const WalkPlan& plan, const WalkOptions& options, const scenario::Orders& orders,
                WalkFiles& files, const WalkResult& result, const Sweep& swept,
                const cli::Json& more = cli::Json::object(), const std::string& more_text = "");

}  // namespace verp::tool
