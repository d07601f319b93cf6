#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::tool {

/// One command per file; each adds its options.
cli::Subcommand add_walk(CLI::App& root);
cli::Subcommand add_action(CLI::App& root);
cli::Subcommand add_demo(CLI::App& root);
cli::Subcommand add_hil(CLI::App& root);
cli::Subcommand add_run(CLI::App& root);
cli::Subcommand add_shadow(CLI::App& root);
cli::Subcommand add_replay(CLI::App& root);
cli::Subcommand add_diff(CLI::App& root);
cli::Subcommand add_compare(CLI::App& root);
cli::Subcommand add_identify(CLI::App& root);
cli::Subcommand add_tune(CLI::App& root);
cli::Subcommand add_check(CLI::App& root);
cli::Subcommand add_export(CLI::App& root);
cli::Subcommand add_new(CLI::App& root);
cli::Subcommand add_completion(CLI::App& root);
cli::Subcommand add_parameters(CLI::App& root);
cli::Subcommand add_trace(CLI::App& root);
cli::Subcommand add_bench(CLI::App& root);
cli::Subcommand add_bus(CLI::App& root);
cli::Subcommand add_flash(CLI::App& root);
cli::Subcommand add_view(CLI::App& root);
cli::Subcommand add_deploy(CLI::App& root);
cli::Subcommand add_debug(CLI::App& root);

}  // namespace verp::tool
