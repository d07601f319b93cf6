#pragma once
#include <string>

#include "host/study/report/plots.hpp"
#include "host/study/signals/series.hpp"

namespace verp::signals {

/// Signals over time, panels_of them one below the other on one time axis. What is asked of a joint
/// is dashed.
report::Plot plot_of(const Series& series, const std::string& title);

}  // namespace verp::signals
