#include <utility>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/program.hpp"
#include "host/apps/pictures/commands.hpp"
#include "host/show/render/renderer.hpp"

namespace {

/// A RenderError is bad input: an oversized or unwritable picture is not a bug.
verp::cli::Subcommand told(verp::cli::Subcommand command) {
  command.run = [run = std::move(command.run)] {
    try {
      return run();
    } catch (const verp::render::RenderError& error) {
      throw verp::cli::ToolError(verp::cli::kBadInput, error.what());
    }
  };
  return command;
}

std::vector<verp::cli::Subcommand> commands(CLI::App& root) {
  return {told(verp::pictures::add_shot(root)), told(verp::pictures::add_video(root))};
}

}  // namespace

int main(int argc, char** argv) {
  return verp::cli::run_program(argc, argv, commands);
}
