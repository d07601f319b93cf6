#pragma once
#include <vector>

#include "host/study/compare/compare.hpp"
#include "host/study/report/plots.hpp"

namespace verp::compare {

/// Both angles of each joint over some cycles.
report::Plot angles_plot(const Comparison& comparison, const Pair& pair);
report::Plot joints_plot(const Comparison& comparison);

}  // namespace verp::compare
