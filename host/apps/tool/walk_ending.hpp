#pragma once
#include <string>

#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_report.hpp"
#include "host/apps/tool/walk_sweep.hpp"

namespace verp::tool {

/// Ends a command that walked: writes files, answers, reports a failure and returns the exit
/// status. `more`: further results.
int finish_walk(const WalkPlan& plan, const WalkOptions& options, const scenario::Orders& orders,
                WalkFiles& files, const WalkResult& result, const Sweep& swept,
                const cli::Json& more = cli::Json::object(), const std::string& more_text = "");

}  // namespace verp::tool
