#include "host/apps/tool/own_controller.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/firmware_build.hpp"
#include "host/os/files/places.hpp"
#include "host/run/own/loaded.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

/// The canonical path of a folder with a writable build/.
fs::path checked(const std::string& words) {
  std::error_code error;
  if (!fs::exists(files::source_dir() / "toolchains" / "own_controller.cmake", error)) {
    throw cli::ToolError(cli::kBadInput,
                         "--controller: a controller is built on VERP's sources, which an "
                         "installed verp has none of; take the ./verp of a clone");
  }
  const fs::path folder = fs::weakly_canonical(words, error), build = folder / "build";
  for (const char* file : {"controller.hpp", "CMakeLists.txt"}) {
    if (fs::exists(folder / file, error)) continue;
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("--controller {}: has no {}; `verp new controller NAME` "
                                     "lays out a folder that has",
                                     words, file));
  }
  fs::create_directories(build, error);
  if (!error && ::access(build.c_str(), W_OK) == 0) return folder;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("--controller {}: {} cannot be written; copy the folder "
                                   "to where you may write",
                                   words, build.string()));
}

fs::path lock_of(const fs::path& folder) {
  return folder / "build" / ".lock";
}

fs::path log_of(const fs::path& folder) {
  return folder / "build" / "failed.log";
}

}  // namespace

std::function<session::Decide()> own_controller(const std::string& words, bool show) {
  const fs::path folder = checked(words), tree = folder / "build" / "pc";
  cli::Progress progress(show);
  std::error_code error;
  if (!fs::exists(tree / "build.ninja", error)) {
    run_build({"cmake", "-S", folder.string(), "-B", tree.string(), "-G", "Ninja",
               "-DCMAKE_BUILD_TYPE=Release", "-DVERP_ROOT=" + files::source_dir().string(),
               "-DVERP_BUILD=" + files::build_dir().string()},
              lock_of(folder), log_of(folder), progress);
  }
  run_build({"cmake", "--build", tree.string()}, lock_of(folder), log_of(folder), progress);
  const auto loaded = std::make_shared<const own::Loaded>(folder, tree / "controller.so");
  return [loaded] { return own::Loaded::controller(loaded); };
}

std::string build_firmware_of(const std::string& words, const std::string& board,
                              const std::string& target, cli::Progress& progress) {
  const fs::path folder = checked(words), tree = folder / "build" / ("fw-" + board);
  std::error_code error;
  if (!fs::exists(files::source_dir() / "boards" / board / "memory.ld", error))
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("--controller {}: there is no board '{}'", words, board));
  if (!fs::exists(tree, error))
    cli::complain(fmt::format("verp: building {} for {}: the first time takes a minute",
                              folder.filename().string(), board));
  build_firmware({.board = board,
                  .target = target,
                  .tree = tree,
                  .settings = {"-DVERP_CONTROLLER=" + folder.string()},
                  .log = log_of(folder),
                  .lock = lock_of(folder)},
                 progress);
  return (tree / "images").string();
}

void take_controllers(const scenario::Scenario& scenario, std::vector<session::WalkPlan>& plans,
                      bool show) {
  std::map<std::string, std::function<session::Decide()>> built;
  for (session::WalkPlan& plan : plans) {
    const auto number = static_cast<std::size_t>(plan.number);
    const std::string& folder = scenario.robots[number].controller.folder;
    if (folder.empty() || !plan.link.empty()) continue;
    auto& own = built[folder];
    if (!own) own = own_controller(folder, show);
    plan.own = own;
    cli::Progress progress(show);
    if (!plan.board.empty())
      plan.firmware_folder = build_firmware_of(folder, plan.board, "loop_" + plan.board, progress);
  }
}

}  // namespace verp::tool
