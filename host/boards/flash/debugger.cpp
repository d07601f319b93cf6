#include "host/boards/flash/debugger.hpp"

#include <fmt/format.h>

#include "host/boards/board/replay_on_target.hpp"
#include "host/boards/flash/images.hpp"
#include "host/os/files/shell_line.hpp"

namespace verp::flash {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> gdb_words(const std::string& gdb, const fs::path& image,
                                   const std::string& target,
                                   const std::vector<std::string>& first) {
  std::vector<std::string> words = {gdb, "-q", image.string(), "-ex", target};
  for (const std::string& each : first) words.insert(words.end(), {"-ex", each});
  return words;
}

/// QEMU halts at the start. gdb uses its streams, so output goes to a file.
std::string qemu_behind_a_pipe(board::QemuProcess::Launch launch, const fs::path& folder) {
  launch.console = "words";
  launch.options.insert(
      launch.options.end(),
      {"-chardev", "file,id=words,path=" + (folder / "output").string(), "-S", "-gdb", "stdio"});
  return "target remote | exec " + files::shell_line(board::QemuProcess::command(launch));
}

/// The ELF file with gdb's symbols.
fs::path symbols_of(fs::path image) {
  return image.replace_extension(".elf");
}

}  // namespace

DebugPlan debug_chip(const std::string& gdb, const Recipe& recipe, BusProtocol protocol,
                     const std::string& probe) {
  std::vector<std::string> openocd = {"openocd", "-f", recipe.probe, "-f",
                                      recipe.chip->openocd_target};
  if (!probe.empty()) openocd.insert(openocd.end(), {"-c", "adapter serial " + probe});
  // A log would mix with the gdb protocol.
  openocd.insert(openocd.end(), {"-c", "gdb_port pipe; log_output /dev/null"});
  return {gdb_words(gdb, symbols_of(code_image(recipe, loop_image(recipe, protocol))),
                    "target extended-remote | exec " + files::shell_line(openocd),
                    {"monitor reset halt", "tbreak verp_main", "continue"})};
}

DebugPlan debug_emulation(const std::string& gdb, const EmulationPlan& plan,
                          const fs::path& folder) {
  return {gdb_words(gdb, symbols_of(plan.launch.image), qemu_behind_a_pipe(plan.launch, folder),
                    {"tbreak verp_main", "continue"}),
          plan.links};
}

DebugPlan debug_replay(const std::string& gdb, const std::string& board, const Params& params,
                       std::span<const Inputs> inputs, std::uint32_t index,
                       const fs::path& folder) {
  const board::EmulatedBoard& emulated = board::find_emulated_board(board);
  const fs::path image = firmware_image(emulated, "replay"), job = folder / "job";
  board::write_replay_job(job, params, inputs);
  const board::QemuProcess::Launch launch{
      .board = emulated, .image = image, .arguments = {job.string(), (folder / "result").string()}};
  return {gdb_words(gdb, image, qemu_behind_a_pipe(launch, folder),
                    {"break verp::step", fmt::format("ignore 1 {}", index), "continue"})};
}

}  // namespace verp::flash
