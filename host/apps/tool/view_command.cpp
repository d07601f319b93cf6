#include "host/apps/tool/view_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "host/apps/cli/other_program.hpp"

namespace verp::tool {
CLI::App* declare_view(CLI::App& root, ViewOptions& words) {
  WalkOptions& options = words.walk;
  CLI::App* app = cli::declare_other(root, "view");
  options.command = "verp view";
  options.walk_s = 20;
  declare(*app, options);
  // Removes the options that are for unattended runs.
  for (const char* name : {"--report", "--record-state", "--compress", "--json", "--sweep-step",
                           "--seeds", "--on", "--list-quantities", "--cameras", "--real-time",
                           "--patience", "--if-lost-go-on", "--print-scenario"}) {
    app->remove_option(app->get_option(name));
  }
  app->get_option("MODEL")->description(
      "a robot of common/robots, the path of an SDF file, or a trace (.mcap)");
  app->add_option("--link", words.link,
                  "stand the controller at the end of it beside the robot: its operator's port, "
                  "serial:DEVICE@BAUD, pty:PATH, tcp:HOST:PORT or unix:PATH; or can:INTERFACE");
  app->add_option("--gamepad", words.gamepad,
                  "steer by this joystick, whenever it is plugged in: sticks walk and turn, the "
                  "first button stands, the second is the emergency stop")
      ->capture_default_str();
  return app;
}

cli::Subcommand add_view(CLI::App& root) {
  auto options = std::make_shared<ViewOptions>();
  return {declare_view(root, *options), [options]() -> int { cli::start_other("view"); }};
}

}  // namespace verp::tool
