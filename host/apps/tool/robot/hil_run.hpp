#pragma once
#include <vector>

#include "host/apps/tool/walk_run.hpp"
#include "host/run/session/remote_controller.hpp"

namespace verp::tool {

struct HilResult : session::RemoteResult {
  WalkResult walk;

  double ticks_per_s() const {
    return walk.wall_s > 0 ? static_cast<double>(walk.ticks) / walk.wall_s : 0;
  }
};

/// Serves the twin to a controller at the end of a link (session::RemoteController) until the
/// controller or the walk ends. Throws what opening a link throws.
HilResult serve_controller(const WalkPlan& plan, session::ServeOptions options,
                           cli::Progress& progress, std::vector<session::Observer*> observers);

}  // namespace verp::tool
