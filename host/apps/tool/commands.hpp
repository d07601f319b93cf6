#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::tool {

/// One command per file; each adds its options.
cli::Subcommand add_walk(CLI::App& root);
cli::Subcommand add_replay(CLI::App& root);
cli::Subcommand add_diff(CLI::App& root);
cli::Subcommand add_completion(CLI::App& root);
cli::Subcommand add_parameters(CLI::App& root);
cli::Subcommand add_view(CLI::App& root);

}  // namespace verp::tool
