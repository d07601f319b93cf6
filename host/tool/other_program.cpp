#include "host/tool/other_program.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "host/tool/exit_status.hpp"

namespace verp::tool {
namespace {

/// Becomes that program; it gets the word and all after it.
[[noreturn]] void become(const std::string& word, std::vector<std::string> arguments) {
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "../pictures/verp_pictures";
  std::vector<char*> argv;
  std::string name = "verp", first = word;
  argv.push_back(name.data());
  argv.push_back(first.data());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  throw ToolError(
      kNoDevice,
      fmt::format("verp {0}: the program that draws cannot be started ({1}); `./verp {0}` "
                  "builds it, or: ninja -C build/host-release verp_pictures",
                  word, std::strerror(errno)));
}

Subcommand add_word(CLI::App& root, const char* word, const char* what) {
  CLI::App* app = root.add_subcommand(word, what);
  app->prefix_command();
  app->set_help_flag();
  return {app, [app, word]() -> int { become(word, app->remaining()); }};
}

}  // namespace

Subcommand add_shot(CLI::App& root) {
  return add_word(root, "shot", "A picture of a robot, of a moment of its walk, or of a trace");
}

Subcommand add_video(CLI::App& root) {
  return add_word(root, "video", "A video of a walk in the twin, or of a trace");
}

}  // namespace verp::tool
