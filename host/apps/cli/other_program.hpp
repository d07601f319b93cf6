#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::cli {

/// Subcommands that run as programs of their own, so that `verp` does not need their libraries.
/// Shot and video are in host/apps/pictures, edit in host/author/edit/words.
Subcommand add_shot(CLI::App& root);
Subcommand add_video(CLI::App& root);
Subcommand add_edit(CLI::App& root);

}  // namespace verp::cli
