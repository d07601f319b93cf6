#pragma once
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/run/session/estimate_meter.hpp"

/// How far the controller's estimates were off, in words.
namespace verp::tool {

/// Empty: nothing was compared.
std::string estimate_text(const session::EstimateErrors& errors);
/// null: nothing was compared.
cli::Json estimate_json(const session::EstimateErrors& errors);
/// Of several walks, as estimate_json() told them: root mean squares over all, and in how many of
/// them roll and pitch were known to 0.5 degrees rms each, and the velocity of the centre of mass
/// to 0.03 m/s, with the interval of that share.
std::string estimates_text(const std::vector<cli::Json>& walks);

}  // namespace verp::tool
