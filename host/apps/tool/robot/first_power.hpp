#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/apps/cli/answers.hpp"

namespace verp::tool {

std::string first_power_checklist(const Params& params);

/// Prints the checklist and asks the user to confirm it; `agreed`: confirmed on the command line.
/// Throws ToolError without confirmation.
void confirm_first_power(const Params& params, bool agreed, cli::Answers& answers);

}  // namespace verp::tool
