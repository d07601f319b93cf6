#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/apps/cli/answers.hpp"

namespace verp::tool {

std::string first_power_checklist(const Params& params);

/// Asks the user to confirm the checklist; `agreed`: done on the command line. Throws ToolError
/// without it.
void confirm_first_power(const Params& params, bool agreed, cli::Answers& answers);

}  // namespace verp::tool
