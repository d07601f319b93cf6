#include "host/tool/firmware_build.hpp"

#include <fmt/format.h>

#include <fstream>

#include "host/files/places.hpp"
#include "host/flash/tool_run.hpp"
#include "host/tool/exit_status.hpp"
#include "host/tool/interrupt.hpp"

namespace verp::tool {
namespace {

void must(const std::vector<std::string>& command, const FirmwareBuild& build, Progress& progress) {
  std::vector<std::string> locked = {"flock", (files::source_dir() / "build" / ".lock").string()};
  locked.insert(locked.end(), command.begin(), command.end());
  progress.show(0, "build");
  const flash::ToolRun run = flash::run_tool(
      locked, "cmake",
      {.share = [&](double share) { progress.show(share, "build"); }, .stop = interrupted});
  progress.clear();
  if (run.interrupted) throw ToolError(kRunFailed, "interrupted");
  if (run.status == 0) return;
  std::ofstream(build.log) << run.output;
  const std::size_t error = run.output.find("rror: ");
  std::string words = flash::last_line(run.output);
  if (error != std::string::npos) {
    const std::size_t begin = run.output.rfind('\n', error) + 1;
    words = run.output.substr(begin, run.output.find('\n', error) - begin);
  }
  throw ToolError(kRunFailed, fmt::format("{}; all of it: {}", words, build.log.string()));
}

}  // namespace

void build_firmware(const FirmwareBuild& build, Progress& progress) {
  const std::string root = files::source_dir().string(), preset = "fw-" + build.board;
  const std::string tree = build.tree.empty() ? root + "/build/" + preset : build.tree.string();
  std::vector<std::string> configure = {"env", "-C", root, "cmake", "--preset", preset, "-B", tree};
  configure.insert(configure.end(), build.settings.begin(), build.settings.end());
  must(configure, build, progress);
  must({"cmake", "--build", tree, "--target", build.target}, build, progress);
}

}  // namespace verp::tool
