#include "host/apps/tool/firmware_build.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/boards/flash/tool_run.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/process/child.hpp"

namespace verp::tool {

namespace {

std::string line_at(const std::string& text, std::size_t place) {
  const std::size_t begin = text.rfind('\n', place) + 1;
  return text.substr(begin, text.find('\n', place) - begin);
}

/// The first line that says why. The linker's of an image that is too large has no "error";
/// budget: and TOO MUCH are of boards/stm32/budget.
std::string reason_of(const std::string& output) {
  const std::size_t over = output.find("overflowed by"), error = output.find("rror: ");
  const std::size_t budget = output.find("budget: "), row = output.find("TOO MUCH");
  if (over != std::string::npos) {
    const std::string line = line_at(output, over);
    return "the image is too large: " + line.substr(line.find("region")) +
           "; take a smaller controller, or a board with more flash (opencr)";
  }
  const std::size_t first = std::min({error, budget, row});
  return first != std::string::npos ? line_at(output, first) : process::last_line(output);
}

}  // namespace

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
  throw cli::ToolError(cli::kRunFailed,
                       fmt::format("{}; {}{}", reason_of(run.output),
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
