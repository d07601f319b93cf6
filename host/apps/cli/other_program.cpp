#include "host/apps/cli/other_program.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "host/apps/cli/exit_status.hpp"

namespace verp::cli {
namespace {

struct OtherProgram {
  const char *path, *target;  ///< path is relative to this program
};
constexpr OtherProgram kPictures = {"../pictures/verp_pictures", "verp_pictures"};
constexpr OtherProgram kEditor = {"../edit/verp_edit", "verp_edit"};

/// Passes the word and all following arguments.
[[noreturn]] void become(const OtherProgram& other, const std::string& word,
                         std::vector<std::string> arguments) {
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / other.path;
  std::vector<char*> argv;
  std::string name = "verp", first = word;
  argv.push_back(name.data());
  argv.push_back(first.data());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  throw ToolError(kNoDevice,
                  fmt::format("verp {0}: its program cannot be started ({1}); `./verp {0}` "
                              "builds it, or: ninja -C build/host-release {2}",
                              word, std::strerror(errno), other.target));
}

Subcommand add_word(CLI::App& root, const OtherProgram& other, const char* word, const char* what) {
  CLI::App* app = root.add_subcommand(word, what);
  app->prefix_command();
  app->set_help_flag();
  return {app, [app, &other, word]() -> int { become(other, word, app->remaining()); }};
}

}  // namespace

Subcommand add_shot(CLI::App& root) {
  return add_word(root, kPictures, "shot",
                  "A picture of a robot, of a moment of its walk, or of a trace");
}

Subcommand add_video(CLI::App& root) {
  return add_word(root, kPictures, "video", "A video of a walk in the twin, or of a trace");
}

Subcommand add_edit(CLI::App& root) {
  return add_word(root, kEditor, "edit",
                  "Change a robot's file: set, add, delete, mirror, import a mesh");
}

}  // namespace verp::cli
