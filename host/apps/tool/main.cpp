#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/program.hpp"
#include "host/apps/tool/commands.hpp"

namespace {

namespace cli = verp::cli;
using namespace verp::tool;

std::vector<cli::Subcommand> all_commands(CLI::App& root) {
  return {add_walk(root),      add_action(root),     add_demo(root),       add_view(root),
          add_hil(root),       add_run(root),        add_shadow(root),     add_replay(root),
          add_diff(root),      add_compare(root),    add_identify(root),   add_tune(root),
          add_check(root),     add_export(root),     add_parameters(root), add_new(root),
          cli::add_edit(root), add_completion(root), add_trace(root),      add_bench(root),
          add_bus(root),       add_flash(root),      add_deploy(root),     add_debug(root),
          cli::add_shot(root), cli::add_video(root)};
}

}  // namespace

int main(int argc, char** argv) {
  return cli::run_program(argc, argv, all_commands);
}
