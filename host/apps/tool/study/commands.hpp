#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::tool {

cli::Subcommand add_demo(CLI::App& root);
cli::Subcommand add_faults(CLI::App& root);
cli::Subcommand add_compare(CLI::App& root);
cli::Subcommand add_identify(CLI::App& root);
cli::Subcommand add_tune(CLI::App& root);
cli::Subcommand add_trace(CLI::App& root);
cli::Subcommand add_bench(CLI::App& root);

}  // namespace verp::tool
