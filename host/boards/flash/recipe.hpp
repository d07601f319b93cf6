#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// One row per board, one per chip.
namespace verp::flash {

enum class Tool : std::uint8_t { kOpenocd, kStm32flash, kDfuUtil };

/// Name of the program and its Debian package.
const char* name_of(Tool tool);

/// Sectors of one size; the chip erases whole ones.
struct SectorRun {
  std::uint32_t count, bytes;
};

struct Chip {
  const char* name;
  std::uint16_t device_id;  ///< DBGMCU_IDCODE bits 11:0
  const char* openocd_target;
  std::vector<SectorRun> sectors;  ///< from kFlashBegin
};

inline constexpr std::uint32_t kFlashBegin = 0x08000000;

struct Recipe {
  const char* board;
  const Chip* chip;          ///< null: emulation only
  std::vector<Tool> tools;   ///< default first
  const char* probe;         ///< OpenOCD configuration of the debug probe
  const char* serial_pins;   ///< serial port of the boot loader
  const char* replay_board;  ///< emulated board with the same core
  bool can_image = false;    ///< a second image for CAN
  bool foot_image = false;   ///< pins for a foot's cells
};

const std::vector<Recipe>& recipes();

/// Throws FlashError with the boards.
const Recipe& find_recipe(const std::string& board);

/// [begin, begin + bytes). sectors_around(): the whole sectors around it.
struct Span {
  std::uint32_t begin, bytes;
  std::uint32_t end() const { return begin + bytes; }
  bool overlaps(const Span& other) const { return begin < other.end() && other.begin < end(); }
};
Span sectors_around(const Chip& chip, const Span& span);

/// "04*016Kg,01*064Kg,07*128Kg", as the DFU boot loader has it.
std::string dfu_layout(const Chip& chip);

}  // namespace verp::flash
