#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::tool {

cli::Subcommand add_new_controller(CLI::App& parent);

}  // namespace verp::tool
