#include "host/apps/cli/program.hpp"
#include "host/apps/tool/commands.hpp"

namespace {

namespace cli = verp::cli;
using namespace verp::tool;

std::vector<cli::Subcommand> commands_of_a_walk(CLI::App& root) {
  return {add_walk(root),  add_replay(root), add_diff(root),
          add_check(root), add_export(root), add_parameters(root)};
}

}  // namespace

int main(int argc, char** argv) {
  return cli::run_program(argc, argv, commands_of_a_walk);
}
