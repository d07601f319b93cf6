#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::pictures {

cli::Subcommand add_shot(CLI::App& root);
cli::Subcommand add_video(CLI::App& root);

}  // namespace verp::pictures
