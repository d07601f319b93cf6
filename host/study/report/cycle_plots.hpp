#pragma once
#include "host/study/report/csv.hpp"
#include "host/study/report/plots.hpp"

namespace verp::report {

Plot joint_plot(const Run& run, const Range& cycle);
Plot key_point_plot(const Run& run, const Range& cycle);

}  // namespace verp::report
