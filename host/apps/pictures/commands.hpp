#pragma once
#include "host/apps/cli/command.hpp"

/// The words that need OpenGL.
namespace verp::pictures {

tool::Subcommand add_shot(CLI::App& root);
tool::Subcommand add_video(CLI::App& root);

}  // namespace verp::pictures
