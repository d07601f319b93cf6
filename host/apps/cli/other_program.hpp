#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::cli {

/// Words of `verp` that a program of its own answers, so that this one needs none of its libraries:
/// shot and video are host/apps/pictures, edit is host/author/edit/words.
Subcommand add_shot(CLI::App& root);
Subcommand add_video(CLI::App& root);
Subcommand add_edit(CLI::App& root);

}  // namespace verp::cli
