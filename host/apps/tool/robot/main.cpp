#include "host/apps/cli/program.hpp"
#include "host/apps/tool/robot/commands.hpp"

namespace {

using namespace verp::tool;

std::vector<verp::cli::Subcommand> commands(CLI::App& root) {
  return {add_action(root), add_hil(root),    add_run(root),   add_shadow(root), add_check(root),
          add_export(root), add_import(root), add_new(root),   add_bus(root),    add_flash(root),
          add_deploy(root), add_debug(root),  add_doctor(root)};
}

}  // namespace

int main(int argc, char** argv) {
  return verp::cli::run_program(argc, argv, commands);
}
