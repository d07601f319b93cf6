#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/program.hpp"

namespace {

using namespace verp::tool;

std::vector<Subcommand> all_commands(CLI::App& root) {
  return {add_walk(root),  add_action(root),     add_demo(root),       add_view(root),
          add_hil(root),   add_run(root),        add_shadow(root),     add_replay(root),
          add_diff(root),  add_compare(root),    add_identify(root),   add_tune(root),
          add_check(root), add_export(root),     add_parameters(root), add_new(root),
          add_edit(root),  add_completion(root), add_trace(root),      add_bench(root),
          add_bus(root),   add_flash(root),      add_deploy(root),     add_debug(root),
          add_shot(root),  add_video(root)};
}

}  // namespace

int main(int argc, char** argv) {
  return verp::tool::run_program(argc, argv, all_commands);
}
