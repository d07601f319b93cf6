#pragma once
#include "host/study/report/plots.hpp"
#include "host/study/survey/push_map.hpp"
#include "host/study/survey/stability_map.hpp"

namespace verp::survey {

/// Phase by direction; and from above, over all phases, by direction.
report::Plot push_plot(const PushMap& map, const PushOptions& options);
report::Plot push_rose(const PushMap& map, const PushOptions& options);

/// Both planes: how each velocity that was asked ended, and what was really walked.
report::Plot stability_plot(const StabilityMap& map, const StabilityOptions& options);

}  // namespace verp::survey
