#pragma once
#include "host/apps/tool/walk_options.hpp"
#include "host/apps/view/run/live_run.hpp"

namespace verp::view {

/// Throws what `verp walk` would.
RunSetup run_of(const tool::WalkOptions& options);

}  // namespace verp::view
