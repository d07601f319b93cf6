#pragma once
#include <optional>

#include "host/study/report/csv.hpp"
#include "host/study/report/plots.hpp"

namespace verp::report {

/// The robot from its right side in the 16 states of a cycle, side by side.
Plot figure_plot(const Run& run, const Range& cycle);

/// The walk in one picture: the robot's 16 states above the ZMP's track. nullopt: the run has no
/// steady cycle.
std::optional<Plot> poster(const Run& run);

}  // namespace verp::report
