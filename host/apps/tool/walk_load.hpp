#pragma once
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/study/report/run_data.hpp"

namespace verp::tool {

/// The joint with the highest average load.
std::string hardest_used(const WalkPlan& plan, const sim::WalkMetrics& metrics);
std::string transport_text(const sim::WalkMetrics& metrics);
report::Fact transport_fact(const sim::WalkMetrics& metrics);
cli::Json load_json(const WalkPlan& plan, const sim::WalkMetrics& metrics);

}  // namespace verp::tool
