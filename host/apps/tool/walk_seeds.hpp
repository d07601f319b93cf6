#pragma once
#include "host/apps/tool/walk_options.hpp"

namespace verp::tool {

/// Runs --seeds and reports survivors. Each walk is a process, one per core at a time. A fall is a
/// result, not an error. Returns 1 after an interrupt, else the first failed start's status.
int walk_seeds(const WalkOptions& options);

}  // namespace verp::tool
