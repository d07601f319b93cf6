#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// How each board of boards/ gets its firmware: one row a board, one row a chip.
namespace verp::flash {

enum class Tool : std::uint8_t { kOpenocd, kStm32flash, kDfuUtil };

/// Its program, and the Debian package of the same name.
const char* name_of(Tool tool);

/// Sectors of one size that follow each other; a sector is erased as a whole.
struct SectorRun {
  std::uint32_t count, bytes;
};

struct Chip {
  const char* name;
  std::uint16_t device_id;  ///< DBGMCU_IDCODE bits 11:0, which the boot loader's Get ID tells too
  const char* openocd_target;
  std::vector<SectorRun> sectors;  ///< from kFlashBegin on
};

inline constexpr std::uint32_t kFlashBegin = 0x08000000;

struct Recipe {
  const char* board;
  const Chip* chip;          ///< null: the board is only ever emulated
  std::vector<Tool> tools;   ///< the usual one first
  const char* probe;         ///< OpenOCD's configuration of the debug probe
  const char* serial_pins;   ///< where the boot loader's serial port is
  const char* replay_board;  ///< an emulated board with the same core
  bool can_image = false;    ///< there is a second image, for robots on CAN
};

const std::vector<Recipe>& recipes();

/// Throws FlashError with the boards there are.
const Recipe& find_recipe(const std::string& board);

/// The one sector, or the neighbouring sectors, that hold [begin, begin + bytes).
struct Span {
  std::uint32_t begin, bytes;
  std::uint32_t end() const { return begin + bytes; }
  bool overlaps(const Span& other) const { return begin < other.end() && other.begin < end(); }
};
Span sectors_around(const Chip& chip, const Span& span);

/// The chip's sectors as its DFU boot loader words them: "04*016Kg,01*064Kg,07*128Kg".
std::string dfu_layout(const Chip& chip);

}  // namespace verp::flash
