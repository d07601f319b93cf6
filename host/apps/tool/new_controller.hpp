#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::tool {

/// `verp new controller`, a subcommand of `new`.
cli::Subcommand add_new_controller(CLI::App& parent);

}  // namespace verp::tool
