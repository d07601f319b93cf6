#pragma once
#include <vector>

#include "host/apps/cli/command.hpp"

namespace verp::cli {

using AddCommands = std::vector<Subcommand> (*)(CLI::App& root);

/// What a main() does: the command line, one of these commands, errors as one line, and the exit
/// status.
int run_program(int argc, char** argv, AddCommands add_commands);

}  // namespace verp::cli
