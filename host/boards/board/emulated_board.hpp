#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace verp::board {

struct EmulatedBoard {
  const char* name;  ///< as in boards/ and VERP_BOARD
  const char* machine;
  const char* core;
  bool measured;  ///< `verp bench` shows its costs; it has an image that times the link
  const char* program = "qemu-system-arm";
  const char* package = "qemu-system-arm";
  std::vector<std::string> options = {};
  /// QEMU's option for the image, and the prefix of the file name.
  const char* image_option = "-kernel";
  const char* image_prefix = "";
  /// Options that connect its CAN controller to QEMU's bus `can0_bus`; empty: no CAN.
  std::vector<std::string> can = {};
};

const std::vector<EmulatedBoard>& emulated_boards();

/// Throws NoSuchBoard, which lists the valid names.
const EmulatedBoard& find_emulated_board(const std::string& name);

/// Image `what` ("unit", "replay", "loop") of a board. It is in the folder `images` if given, else
/// in $VERP_FIRMWARE_DIR if set, else in the build folder of the preset fw-<board>. Throws
/// NoSuchBoard with the build command if it is missing.
std::filesystem::path firmware_image(const EmulatedBoard& board, const std::string& what,
                                     const std::string& images = "");

}  // namespace verp::board
