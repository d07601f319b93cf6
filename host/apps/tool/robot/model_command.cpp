#include <CLI/CLI.hpp>
#include <memory>

#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/robot/model/check.hpp"
#include "host/robot/model/export.hpp"

namespace verp::tool {

cli::Subcommand add_check(CLI::App& root) {
  struct Options {
    std::string model, bus;
    bool json = false;
  };
  CLI::App* app = cli::declare_other(root, "check");
  auto options = std::make_shared<Options>();
  cli::add_model(*app, options->model)->required();
  cli::add_bus_option(*app, options->bus);
  cli::add_json_flag(*app, options->json);
  return {app,
          [options] { return model::check_command(options->model, options->bus, options->json); }};
}

cli::Subcommand add_export(CLI::App& root) {
  struct Options {
    std::string model, bus, folder;
  };
  CLI::App* app = cli::declare_other(root, "export");
  auto options = std::make_shared<Options>();
  cli::add_model(*app, options->model)->required();
  cli::add_bus_option(*app, options->bus);
  app->add_option("-o,--output", options->folder, "folder")->required();
  return {app, [options] {
            return model::export_command(options->model, options->bus, options->folder);
          }};
}

}  // namespace verp::tool
