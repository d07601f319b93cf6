#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/program.hpp"
#include "host/apps/tool/commands.hpp"

namespace {

namespace cli = verp::cli;
using cli::add_other;
using namespace verp::tool;

std::vector<cli::Subcommand> all_commands(CLI::App& root) {
  return {add_walk(root),
          add_other(root, "action"),
          add_other(root, "demo"),
          add_other(root, "faults"),
          add_view(root),
          add_other(root, "hil"),
          add_other(root, "run"),
          add_other(root, "shadow"),
          add_replay(root),
          add_diff(root),
          add_other(root, "compare"),
          add_other(root, "identify"),
          add_other(root, "tune"),
          add_other(root, "check"),
          add_other(root, "export"),
          add_parameters(root),
          add_other(root, "import"),
          add_other(root, "new"),
          add_other(root, "edit"),
          add_completion(root),
          add_other(root, "trace"),
          add_other(root, "bench"),
          add_other(root, "bus"),
          add_other(root, "doctor"),
          add_other(root, "flash"),
          add_other(root, "deploy"),
          add_other(root, "debug"),
          add_other(root, "shot"),
          add_other(root, "video")};
}

}  // namespace

int main(int argc, char** argv) {
  return cli::run_program(argc, argv, all_commands);
}
