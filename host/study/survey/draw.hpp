#pragma once
#include "host/study/report/plots.hpp"
#include "host/study/survey/push_map.hpp"
#include "host/study/survey/stability_map.hpp"

namespace verp::survey {

/// push_plot(): phase by direction. push_rose(): directions from above, over all phases.
report::Plot push_plot(const PushMap& map, const PushOptions& options);
report::Plot push_rose(const PushMap& map, const PushOptions& options);

/// How each requested velocity ended, and the reached one.
report::Plot stability_plot(const StabilityMap& map, const StabilityOptions& options);

}  // namespace verp::survey
