#pragma once
#include "common/model/params.hpp"
#include "host/study/report/run_data.hpp"
#include "host/twin/sim/metrics.hpp"

namespace verp::tool {

/// Ankles, soles and ZMP of a tick, world axes. Time from `start_s`.
report::Sample to_sample(const Params& params, const sim::SeriesRow& row, double start_s);

}  // namespace verp::tool
