#pragma once
#include "host/tool/hil_run.hpp"

namespace verp::tool {

/// serve_controller() for a robot on CAN: in lockstep, on a SocketCAN interface.
HilResult serve_on_can(const WalkPlan& plan, const HilOptions& options, record::TraceWriter* trace,
                       Progress& progress, bool keep_series);

}  // namespace verp::tool
