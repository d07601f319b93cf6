#include "host/apps/cli/program.hpp"
#include "host/apps/tool/study/commands.hpp"

namespace {

using namespace verp::tool;

std::vector<verp::cli::Subcommand> commands(CLI::App& root) {
  return {add_demo(root), add_faults(root), add_compare(root), add_identify(root),
          add_tune(root), add_trace(root),  add_bench(root)};
}

}  // namespace

int main(int argc, char** argv) {
  return verp::cli::run_program(argc, argv, commands);
}
