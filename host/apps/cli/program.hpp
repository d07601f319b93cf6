#pragma once
#include <vector>

#include "host/apps/cli/command.hpp"

namespace verp::cli {

using AddCommands = std::vector<Subcommand> (*)(CLI::App& root);

int run_program(int argc, char** argv, AddCommands add_commands);

}  // namespace verp::cli
