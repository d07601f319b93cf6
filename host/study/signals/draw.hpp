#pragma once
#include <string>

#include "host/study/report/plots.hpp"
#include "host/study/signals/series.hpp"

namespace verp::signals {

/// Signals over time, in panels (panels_of()) on one time axis. Joint goals are dashed.
report::Plot plot_of(const Series& series, const std::string& title);

}  // namespace verp::signals
