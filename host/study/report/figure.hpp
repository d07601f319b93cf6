#pragma once
#include <optional>

#include "host/study/report/csv.hpp"
#include "host/study/report/plots.hpp"

namespace verp::report {

/// The robot from the right in the 16 states of a cycle.
Plot figure_plot(const Run& run, const Range& cycle);

/// The 16 states above the ZMP's track. nullopt: no steady cycle.
std::optional<Plot> poster(const Run& run);

}  // namespace verp::report
