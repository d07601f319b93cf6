#pragma once
#include "host/apps/demos/run.hpp"
#include "host/study/report/plots.hpp"

namespace verp::demos {

/// Top view: each robot's path, its own estimate of it (thin line), final poses, obstacles, and
/// paths of moved objects.
report::Plot plot_of(const Run& run);

}  // namespace verp::demos
