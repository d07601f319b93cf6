#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/apps/cli/answers.hpp"

namespace verp::tool {

/// What to check before a robot's servos are powered for the first time, one line a point.
std::string first_power_checklist(const Params& params);

/// Shows the checklist on standard error and has it confirmed in a word; `agreed`: it was, on the
/// command line. Throws ToolError if it is not confirmed.
void confirm_first_power(const Params& params, bool agreed, cli::Answers& answers);

}  // namespace verp::tool
