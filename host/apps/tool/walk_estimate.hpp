#pragma once
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/run/session/estimate_meter.hpp"

namespace verp::tool {

/// Empty: nothing was compared.
std::string estimate_text(const session::EstimateErrors& errors);
/// null: nothing was compared.
cli::Json estimate_json(const session::EstimateErrors& errors);
/// Over several estimate_json(): root mean squares, and two shares of walks with confidence
/// intervals. One counts roll and pitch errors of at most 0.5 degrees rms each, the other CoM
/// velocity errors of at most 0.03 m/s.
std::string estimates_text(const std::vector<cli::Json>& walks);

}  // namespace verp::tool
