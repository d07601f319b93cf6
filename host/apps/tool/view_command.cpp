#include "host/apps/tool/view_command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/os/files/whole.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

/// This process's arguments, from the second on.
std::vector<std::string> own_words() {
  const std::string all = files::read("/proc/self/cmdline").value_or("");
  std::vector<std::string> words;
  for (std::size_t at = 0; at < all.size(); at += words.back().size() + 1) {
    words.emplace_back(all.c_str() + at);
  }
  if (!words.empty()) words.erase(words.begin());
  return words;
}

/// This program starts without Qt and OpenGL.
int become_window() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path window = self.parent_path().parent_path() / "view" / "verp_view";
  std::vector<std::string> words = own_words();
  words.insert(words.begin(), window.string());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(window.c_str(), pointers.data());
  throw cli::ToolError(cli::kNoDevice,
                       fmt::format("verp view: {}: the window is not built; start it with "
                                   "./verp view, which installs and builds what it needs",
                                   window.string()));
}

}  // namespace

CLI::App* declare_view(CLI::App& root, ViewOptions& words) {
  WalkOptions& options = words.walk;
  CLI::App* app =
      root.add_subcommand("view",
                          "A window: watch, steer, push and tune a robot in the twin, or "
                          "look into a trace");
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
  return {declare_view(root, *options), [options] { return become_window(); }};
}

}  // namespace verp::tool
