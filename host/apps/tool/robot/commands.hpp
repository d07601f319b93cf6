#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::tool {

cli::Subcommand add_action(CLI::App& root);
cli::Subcommand add_hil(CLI::App& root);
cli::Subcommand add_run(CLI::App& root);
cli::Subcommand add_shadow(CLI::App& root);
cli::Subcommand add_check(CLI::App& root);
cli::Subcommand add_export(CLI::App& root);
cli::Subcommand add_import(CLI::App& root);
cli::Subcommand add_new(CLI::App& root);
cli::Subcommand add_bus(CLI::App& root);
cli::Subcommand add_flash(CLI::App& root);
cli::Subcommand add_deploy(CLI::App& root);
cli::Subcommand add_debug(CLI::App& root);
cli::Subcommand add_doctor(CLI::App& root);

}  // namespace verp::tool
