#include "host/apps/cli/other_program.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "host/apps/cli/exit_status.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/process/child.hpp"

namespace verp::cli {
namespace {

namespace fs = std::filesystem;

/// The folder is relative to that of `verp`. An installed program is in libexec/verp.
struct OtherProgram {
  const char *folder, *target;
};
constexpr OtherProgram kRobot = {".", "verp_robot"}, kStudy = {".", "verp_study"},
                       kPictures = {"../pictures", "verp_pictures"},
                       kEditor = {"../edit", "verp_edit"}, kWindow = {"../view", "verp_view"};

struct Command {
  const char* word;
  const OtherProgram& program;
  const char* what;
};
constexpr Command kCommands[] = {
    {"action", kRobot,
     "Actions of a robot, such as wave or kick: list, check, play, make, convert, export, send, "
     "record"},
    {"demo", kStudy, "Robots that see, talk by radio and act by themselves; without a name: which"},
    {"faults", kStudy, "Field bugs of robots: list them, or inject each and say who catches it"},
    {"view", kWindow,
     "A window: watch, steer, push and tune a robot in the twin, or look into a trace"},
    {"hil", kRobot, "Hardware in the loop: the twin answers a controller on a link"},
    {"run", kRobot, "This PC controls the real servos on a link"},
    {"shadow", kRobot, "Run the controller once more beside one that runs, and compare each tick"},
    {"compare", kStudy,
     "Lay two traces of one command over each other: error, delay, gain, phase of each joint"},
    {"identify", kStudy,
     "Fit the twin's servos to a recorded robot: gain, friction, inertia, play, delay"},
    {"tune", kStudy, "Find a robot's numbers of gait and balance by walks in the twin"},
    {"check", kRobot,
     "Validate a robot; limbs, links, masses, limits, servos, leg solver, bus load"},
    {"export", kRobot, "Write a robot's Params for firmware, or a URDF or MJCF file"},
    {"import", kRobot, "Make a robot of VERP from another maker's file, which is not changed"},
    {"new", kRobot, "Begin a robot or a controller of your own"},
    {"edit", kEditor, "Change a robot's file: set, add, delete, mirror, import a mesh"},
    {"trace", kStudy, "Look into a trace, draw, export, play or cut it, recover what a crash left"},
    {"bench", kStudy,
     "What a tick costs, here and on emulated microcontrollers, beside what is promised"},
    {"bus", kRobot, "Dynamixel and Feetech servos, CANopen nodes: find, read, write, measure"},
    {"doctor", kRobot, "What this machine lacks for VERP, and how to mend it; changes nothing"},
    {"flash", kRobot, "Write firmware or a robot into a board, or start an emulated board"},
    {"deploy", kRobot,
     "From a model to a robot: build, walk in the twin, replay on an emulated core, flash"},
    {"debug", kRobot,
     "gdb on a board's firmware: emulated, behind a probe, or over a trace's ticks"},
    {"shot", kPictures, "A picture of a robot, of a moment of its walk, or of a trace"},
    {"video", kPictures, "A video of a walk in the twin, or of a trace"}};

const Command& command_of(const std::string& word) {
  return *std::find_if(std::begin(kCommands), std::end(kCommands),
                       [&](const Command& each) { return each.word == word; });
}

fs::path path_of(const OtherProgram& program) {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path installed = folder.parent_path() / "libexec/verp" / program.target;
  std::error_code ignored;
  return fs::exists(installed, ignored) ? installed : folder / program.folder / program.target;
}

/// This process's arguments as they were given.
std::vector<std::string> own_words() {
  const std::string all = files::read("/proc/self/cmdline").value_or("");
  std::vector<std::string> words;
  for (std::size_t at = 0; at < all.size(); at += words.back().size() + 1)
    words.emplace_back(all.c_str() + at);
  return words;
}

}  // namespace

CLI::App* declare_other(CLI::App& root, const std::string& word) {
  return root.add_subcommand(word, command_of(word).what);
}

void start_other(const std::string& word) {
  const OtherProgram& other = command_of(word).program;
  std::vector<std::string> words = own_words();
  std::vector<char*> pointers;
  for (std::string& each : words) pointers.push_back(each.data());
  pointers.push_back(nullptr);
  ::execv(path_of(other).c_str(), pointers.data());
  throw ToolError(kNoDevice,
                  fmt::format("verp {0}: its program cannot be started ({1}); `./verp {0}` "
                              "builds it, or: ninja -C build/host-release {2}",
                              word, std::strerror(errno), other.target));
}

Subcommand add_other(CLI::App& root, const std::string& word) {
  CLI::App* app = declare_other(root, word);
  app->prefix_command();
  app->set_help_flag();
  return {app, [word]() -> int { start_other(word); }};
}

std::string trouble_of_other(const std::string& word, const std::vector<std::string>& words) {
  const OtherProgram& other = command_of(word).program;
  const files::TemporaryDirectory folder;
  const fs::path said = folder.path() / "said";
  std::vector<std::string> all = {path_of(other).string(), word};
  all.insert(all.end(), words.begin(), words.end());
  try {
    process::Child child(process::Command{.words = all, .input = {}, .output = {.file = said}});
    if (child.wait() == kGood) return "";
    return process::last_line(files::read(said).value_or(""));
  } catch (const std::system_error&) {
    return fmt::format("{} is not built; `./verp {} --help` builds it", other.target, word);
  }
}

std::vector<ShellWords> words_of_others() {
  std::vector<ShellWords> all;
  const files::TemporaryDirectory folder;
  const fs::path said = folder.path() / "words.json";
  for (const OtherProgram* each : {&kRobot, &kStudy, &kEditor, &kPictures}) {
    try {
      process::Child child(process::Command{
          .words = {path_of(*each).string(), kShellWords}, .input = {}, .output = {.file = said}});
      if (child.wait() != kGood) continue;
    } catch (const std::system_error&) {
      continue;
    }
    std::vector<ShellWords> words = shell_words_in(Json::parse(files::read(said).value_or("")));
    all.insert(all.end(), words.begin() + 1, words.end());  // without the root's
  }
  return all;
}

}  // namespace verp::cli
