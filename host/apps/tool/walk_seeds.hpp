#pragma once
#include "host/apps/tool/walk_options.hpp"

namespace verp::tool {

/// Runs the walks of --seeds and reports how many robots survived. Each walk is a process of this
/// program; as many run at a time as the PC has cores. A fall is a result, not an error. Returns 1
/// after an interrupt, else the exit status of the first walk that could not start.
int walk_seeds(const WalkOptions& options);

}  // namespace verp::tool
