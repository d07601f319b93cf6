#include "host/apps/tool/firmware_build.hpp"

#include <fmt/format.h>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/boards/flash/tool_run.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/process/child.hpp"

namespace verp::tool {

void run_build(const std::vector<std::string>& command, const std::filesystem::path& lock,
               const std::filesystem::path& log, cli::Progress& progress) {
  std::vector<std::string> locked = {"flock", lock.string()};
  locked.insert(locked.end(), command.begin(), command.end());
  progress.show(0, "build");
  const flash::ToolRun run = flash::run_tool(
      locked, "cmake",
      {.share = [&](double share) { progress.show(share, "build"); }, .stop = cli::interrupted});
  progress.clear();
  if (run.interrupted) throw cli::ToolError(cli::kRunFailed, "interrupted");
  if (run.status == 0) return;
  const files::Trouble lost = files::replace(log, run.output);
  const std::size_t error = run.output.find("rror: ");
  std::string words = process::last_line(run.output);
  if (error != std::string::npos) {
    const std::size_t begin = run.output.rfind('\n', error) + 1;
    words = run.output.substr(begin, run.output.find('\n', error) - begin);
  }
  throw cli::ToolError(cli::kRunFailed,
                       fmt::format("{}; {}{}", words,
                                   lost.any() ? "its log is lost: " : "all of it: ", log.string()));
}

void build_firmware(const FirmwareBuild& build, cli::Progress& progress) {
  const std::string root = files::source_dir().string(), preset = "fw-" + build.board;
  const std::string tree = build.tree.empty() ? root + "/build/" + preset : build.tree.string();
  std::vector<std::string> configure = {"env", "-C", root, "cmake", "--preset", preset, "-B", tree};
  configure.insert(configure.end(), build.settings.begin(), build.settings.end());
  const auto lock = build.lock.empty() ? files::source_dir() / "build" / ".lock" : build.lock;
  run_build(configure, lock, build.log, progress);
  run_build({"cmake", "--build", tree, "--target", build.target}, lock, build.log, progress);
}

}  // namespace verp::tool
