#pragma once
#include "host/apps/tool/run_robot.hpp"

namespace verp::tool {

/// Drives a twin that waits for this controller at every tick (`verp walk --robot NAME=ext:LINK`,
/// `verp hil`), so the speed of either side changes no bit. `trace` may be null. Throws ToolError
/// if the twin refuses or does not answer.
RunResult drive_in_lockstep(link::Link& link, const RunPlan& plan, record::TraceWriter* trace,
                            cli::Progress& progress);

}  // namespace verp::tool
