#pragma once
#include "host/apps/tool/robot/run_robot.hpp"

namespace verp::tool {

/// Drives a twin that waits at every tick (`verp walk --robot NAME=ext:LINK`, `verp hil`): no
/// side's speed changes a bit. `trace` may be null. Throws ToolError if the twin refuses or does
/// not answer.
RunResult drive_in_lockstep(link::Link& link, const RunPlan& plan, record::TraceWriter* trace,
                            cli::Progress& progress);

}  // namespace verp::tool
