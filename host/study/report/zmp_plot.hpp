#pragma once
#include "host/study/report/csv.hpp"
#include "host/study/report/plots.hpp"
#include "host/study/report/script.hpp"

namespace verp::report {

/// From above: supporting soles, body, planned and measured ZMP.
Panel zmp_panel(const Run& run, const Range& range);

Plot zmp_plot(const Run& run, const Range& cycle);

}  // namespace verp::report
