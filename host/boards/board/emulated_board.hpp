#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace verp::board {

struct EmulatedBoard {
  const char* name;  ///< as in boards/
  const char* machine;
  const char* core;
  bool measured;  ///< `verp bench` shows its costs and times its link
  const char* program = "qemu-system-arm";
  const char* package = "qemu-system-arm";
  std::vector<std::string> options = {};
  /// QEMU's option for the image, and the prefix of the file name.
  const char* image_option = "-kernel";
  const char* image_prefix = "";
  /// Connects its CAN controller to QEMU's `can0_bus`; empty: no CAN.
  std::vector<std::string> can = {};
};

const std::vector<EmulatedBoard>& emulated_boards();

/// Throws NoSuchBoard with the names.
const EmulatedBoard& find_emulated_board(const std::string& name);

/// Image "unit", "replay" or "loop". In `images` if given, else $VERP_FIRMWARE_DIR, else the build
/// folder of the preset fw-<board>. Throws NoSuchBoard with the build command.
std::filesystem::path firmware_image(const EmulatedBoard& board, const std::string& what,
                                     const std::string& images = "");

}  // namespace verp::board
