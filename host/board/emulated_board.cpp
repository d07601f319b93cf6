#include "host/board/emulated_board.hpp"

#include <algorithm>
#include <cstdlib>

#include "host/board/board_error.hpp"

namespace verp::board {

const std::vector<EmulatedBoard>& emulated_boards() {
  static const std::vector<EmulatedBoard> boards = {
      {"mps2_an385", "mps2-an385", "Cortex-M3", true},
      {"mps2_an386", "mps2-an386", "Cortex-M4F", true},
      {"mps2_an500", "mps2-an500", "Cortex-M7", true},
      {"olimex_h405", "netduinoplus2", "Cortex-M4F", false},
  };
  return boards;
}

const EmulatedBoard& find_emulated_board(const std::string& name) {
  const auto& boards = emulated_boards();
  const auto found = std::find_if(boards.begin(), boards.end(),
                                  [&](const EmulatedBoard& board) { return board.name == name; });
  if (found != boards.end()) return *found;
  std::string known;
  for (const EmulatedBoard& board : boards) known += std::string(" ") + board.name;
  throw NoSuchBoard("no emulated board '" + name + "'; there is:" + known);
}

std::filesystem::path firmware_image(const EmulatedBoard& board, const std::string& what) {
  const std::string name = board.name;
  const char* folder = std::getenv("VERP_FIRMWARE_DIR");
  std::filesystem::path image =
      (folder != nullptr ? std::filesystem::path(folder)
                         : std::filesystem::path(VERP_BUILD_ROOT) / ("fw-" + name) / "images") /
      (what + "_" + name + ".elf");
  if (!std::filesystem::exists(image)) {
    throw NoSuchBoard(image.string() + ": no such firmware image; build it: cmake --preset fw-" +
                      name + " && cmake --build --preset fw-" + name);
  }
  return image;
}

}  // namespace verp::board
