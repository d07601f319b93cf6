#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace verp::board {

/// A folder of boards/ that QEMU can stand in for.
struct EmulatedBoard {
  const char* name;     ///< as in boards/ and VERP_BOARD
  const char* machine;  ///< qemu-system-arm -M
  const char* core;
  bool measured;  ///< one of those whose costs `verp bench` shows: has an image that times the link
};

const std::vector<EmulatedBoard>& emulated_boards();

/// Throws NoSuchBoard, which lists the names there are.
const EmulatedBoard& find_emulated_board(const std::string& name);

/// Image `what` ("unit", "replay", "loop") of a board, in $VERP_FIRMWARE_DIR/<board> if that is
/// set, else where the preset fw-<board> builds it. Throws NoSuchBoard, with the command that
/// builds it, when it isn't there.
std::filesystem::path firmware_image(const EmulatedBoard& board, const std::string& what);

}  // namespace verp::board
