#include "host/apps/cli/program.hpp"

namespace {

using namespace verp::tool;

std::vector<Subcommand> commands_of_a_walk(CLI::App& root) {
  return {add_walk(root),  add_replay(root), add_diff(root),
          add_check(root), add_export(root), add_parameters(root)};
}

}  // namespace

int main(int argc, char** argv) {
  return verp::tool::run_program(argc, argv, commands_of_a_walk);
}
