#include "host/apps/cli/program.hpp"
#include "host/apps/edit/commands.hpp"

namespace {

std::vector<verp::cli::Subcommand> commands(CLI::App& root) {
  return {verp::edit::add_edit(root)};
}

}  // namespace

int main(int argc, char** argv) {
  return verp::cli::run_program(argc, argv, commands);
}
