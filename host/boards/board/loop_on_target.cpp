#include "host/boards/board/loop_on_target.hpp"

#include <chrono>

#include "firmware/app/action_room.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/board/fifo_link.hpp"
#include "host/boards/board/qemu.hpp"

namespace verp::board {
namespace {
constexpr std::chrono::seconds kEnd{10};
}  // namespace

bus::ServerResult run_loop_on(const std::string& board, const Params& params, bus::VirtualBus& bus,
                              const bus::ServerHooks& hooks, const bus::RunOptions& options,
                              const std::string& images) {
  if (options.actions.size_bytes() > app::ActionRoom::kBytes) {
    throw BoardError("the robot's actions take " + std::to_string(options.actions.size_bytes()) +
                     " bytes, and a board has room for " + std::to_string(app::ActionRoom::kBytes) +
                     "; take some out of its folder");
  }
  const EmulatedBoard& emulated = find_emulated_board(board);
  FifoLink link;
  QemuProcess firmware({.board = emulated,
                        .image = firmware_image(emulated, "loop", images),
                        .arguments = {link.to_board().string(), link.from_board().string()}});
  link.connect(firmware, kStart);
  const bus::ByteStreams streams{
      .read_some = [&](void* data,
                       std::size_t size) { return link.read_some(data, size, kSilence); },
      .write = [&](const void* data, std::size_t size) { return link.write(data, size); }};
  bus::ServerResult result = bus::BusServer(params, bus, streams, hooks, options).serve();
  link.close_to_board();
  const int status = firmware.wait(kEnd);
  if (result.exit_code == 3) {
    throw BoardError(
        firmware.described("ended with status " + std::to_string(status) + ": " + result.reason));
  }
  return result;
}

}  // namespace verp::board
