#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace verp::board {

/// A folder of boards/ that QEMU can stand in for.
struct EmulatedBoard {
  const char* name;     ///< as in boards/ and VERP_BOARD
  const char* machine;  ///< QEMU's -M
  const char* core;
  bool measured;  ///< one of those whose costs `verp bench` shows: has an image that times the link
  const char* program = "qemu-system-arm";
  const char* package = "qemu-system-arm";  ///< which has the program
  std::vector<std::string> options = {};    ///< further words that the machine needs
  /// How QEMU gets the image: an option and what stands before the file's name.
  const char* image_option = "-kernel";
  const char* image_prefix = "";
  /// Words that join its CAN controller to QEMU's bus `can0_bus`; none: it has no CAN.
  std::vector<std::string> can = {};
};

const std::vector<EmulatedBoard>& emulated_boards();

/// Throws NoSuchBoard, which lists the names there are.
const EmulatedBoard& find_emulated_board(const std::string& name);

/// Image `what` ("unit", "replay", "loop") of a board, in the folder `images` if that is given,
/// else in $VERP_FIRMWARE_DIR if that is set, else where the preset fw-<board> builds it. Throws
/// NoSuchBoard, with the command that builds it, when it isn't there.
std::filesystem::path firmware_image(const EmulatedBoard& board, const std::string& what,
                                     const std::string& images = "");

}  // namespace verp::board
