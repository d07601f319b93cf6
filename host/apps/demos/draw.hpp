#pragma once
#include "host/apps/demos/run.hpp"
#include "host/study/report/plots.hpp"

namespace verp::demos {

/// From above: where each robot walked (and, thin, where it thought that it was), where it ended
/// and which way it then looked, what stood in its way, and what moved.
report::Plot plot_of(const Run& run);

}  // namespace verp::demos
