#include "host/boards/board/replay_on_target.hpp"

#include <filesystem>
#include <fstream>

#include "firmware/app/replay_job.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/board/qemu.hpp"

namespace verp::board {
namespace {

template <class T>
void put(std::ofstream& file, const T* data, std::size_t count) {
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(count * sizeof(T)));
}

template <class T>
void get(std::ifstream& file, T* data, std::size_t count) {
  file.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(count * sizeof(T)));
}

TargetReplay read_result(const std::filesystem::path& path, std::size_t ticks, bool with_state) {
  TargetReplay result;
  result.digests.resize(ticks);
  ReplayReport report;
  std::ifstream file(path, std::ios::binary);
  get(file, result.digests.data(), ticks);
  get(file, &report, 1);
  if (with_state) get(file, &result.state.emplace(), 1);
  if (!file || report.magic != ReplayJob::kMagic || report.ticks != ticks) {
    throw BoardError(path.string() + ": the board's result is incomplete; rebuild its image");
  }
  result.stack_bytes = report.stack_bytes;
  return result;
}

}  // namespace

void write_replay_job(const std::filesystem::path& path, const Params& params,
                      std::span<const Inputs> inputs, const TargetReplayOptions& options) {
  const ReplayJob job{.ticks = static_cast<std::uint32_t>(inputs.size()),
                      .state_after = options.state_after.value_or(ReplayJob::kNoState)};
  std::ofstream file(path, std::ios::binary);
  put(file, &job, 1);
  put(file, &params, 1);
  put(file, inputs.data(), inputs.size());
  file.close();
  if (!file) throw BoardError(path.string() + ": can't write; free some disk space or set TMPDIR");
}

TargetReplay replay_on(const std::string& board, const Params& params,
                       std::span<const Inputs> inputs, const TargetReplayOptions& options) {
  const EmulatedBoard& emulated = find_emulated_board(board);
  const TemporaryDirectory directory;
  const auto job = directory.path() / "job";
  const auto result = directory.path() / "result";
  write_replay_job(job, params, inputs, options);
  QemuProcess firmware({.board = emulated,
                        .image = firmware_image(emulated, "replay"),
                        .arguments = {job.string(), result.string()},
                        .plugin = options.plugin});
  firmware.wait_for_success(std::chrono::seconds(options.limit_s));
  const bool with_state = options.state_after && *options.state_after < inputs.size();
  return read_result(result, inputs.size(), with_state);
}

}  // namespace verp::board
