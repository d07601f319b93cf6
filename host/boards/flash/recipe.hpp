#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// Flash recipes of the boards in boards/: one row per board, one per chip.
namespace verp::flash {

enum class Tool : std::uint8_t { kOpenocd, kStm32flash, kDfuUtil };

/// Name of the program and of its Debian package.
const char* name_of(Tool tool);

/// Consecutive sectors of one size; the chip erases whole sectors.
struct SectorRun {
  std::uint32_t count, bytes;
};

struct Chip {
  const char* name;
  std::uint16_t device_id;  ///< DBGMCU_IDCODE bits 11:0, also in the boot loader's Get ID
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
  bool can_image = false;    ///< has a second image for robots on CAN
};

const std::vector<Recipe>& recipes();

/// Throws FlashError with the valid boards.
const Recipe& find_recipe(const std::string& board);

/// A byte range of the flash: [begin, begin + bytes). sectors_around() returns the whole sectors
/// that contain it.
struct Span {
  std::uint32_t begin, bytes;
  std::uint32_t end() const { return begin + bytes; }
  bool overlaps(const Span& other) const { return begin < other.end() && other.begin < end(); }
};
Span sectors_around(const Chip& chip, const Span& span);

/// Sectors in the notation of the chip's DFU boot loader: "04*016Kg,01*064Kg,07*128Kg".
std::string dfu_layout(const Chip& chip);

}  // namespace verp::flash
