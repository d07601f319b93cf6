#pragma once
#include "host/apps/tool/run_robot.hpp"

namespace verp::tool {

/// Drives a twin whose time stands still until this controller asks for more (`verp walk --robot
/// NAME=ext:LINK`, `verp hil`): how fast either of them is changes no bit. `trace` may be null.
/// Throws ToolError if the twin refuses or nobody answers.
RunResult drive_in_lockstep(link::Link& link, const RunPlan& plan, record::TraceWriter* trace,
                            cli::Progress& progress);

}  // namespace verp::tool
