#pragma once
#include <string>

#include "host/study/report/plots.hpp"
#include "host/study/signals/series.hpp"

namespace verp::signals {

/// Panels (panels_of()) on one time axis; joint goals are dashed.
report::Plot plot_of(const Series& series, const std::string& title);

}  // namespace verp::signals
