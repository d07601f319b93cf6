#include "host/boards/flash/recipe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/boards/board/emulated_board.hpp"
#include "host/boards/flash/flash_error.hpp"

namespace verp::flash {
namespace {

// Identifiers: RM0090 38.6.1, RM0390 33.6.1, RM0385 40.6.1 (DBGMCU_IDCODE). Sectors: RM0090 3.3 (1
// MB part), RM0390 3.3 (512 KB part), RM0385 3.3. Pins of the boot loaders: AN2606.
constexpr std::uint32_t kKilobyte = 1024;
const Chip kF405 = {"STM32F405",
                    0x413,
                    "target/stm32f4x.cfg",
                    {{4, 16 * kKilobyte}, {1, 64 * kKilobyte}, {7, 128 * kKilobyte}}};
const Chip kF446 = {"STM32F446",
                    0x421,
                    "target/stm32f4x.cfg",
                    {{4, 16 * kKilobyte}, {1, 64 * kKilobyte}, {3, 128 * kKilobyte}}};
const Chip kF746 = {"STM32F746",
                    0x449,
                    "target/stm32f7x.cfg",
                    {{4, 32 * kKilobyte}, {1, 128 * kKilobyte}, {3, 256 * kKilobyte}}};

/// For tests only: its loop takes orders from a file and needs a twin on CAN.
bool is_for_tests(const std::string& board) {
  const auto& boards = board::emulated_boards();
  return std::any_of(boards.begin(), boards.end(), [&](const board::EmulatedBoard& each) {
    return each.name == board && !each.can.empty();
  });
}

}  // namespace

const char* name_of(Tool tool) {
  switch (tool) {
    case Tool::kOpenocd:
      return "openocd";
    case Tool::kStm32flash:
      return "stm32flash";
    case Tool::kDfuUtil:
      return "dfu-util";
  }
  return "";
}

const std::vector<Recipe>& recipes() {
  using enum Tool;
  constexpr const char* kStLink = "interface/stlink.cfg";
  static const std::vector<Recipe> rows = {
      {"olimex_h405",
       &kF405,
       {kOpenocd, kStm32flash, kDfuUtil},
       kStLink,
       "PA9, PA10",
       "olimex_h405",
       true,
       true},
      {"nucleo_f446re",
       &kF446,
       {kOpenocd, kStm32flash},
       kStLink,
       "PA9, PA10",
       "olimex_h405",
       true,
       true},
      // On OpenCR the boot loader's serial pins are only on the servo connectors.
      {"opencr", &kF746, {kDfuUtil, kOpenocd}, kStLink, "", "mps2_an500", true},
      {"mps2_an385", nullptr, {}, "", "", "mps2_an385"},
      {"mps2_an386", nullptr, {}, "", "", "mps2_an386"},
      {"mps2_an500", nullptr, {}, "", "", "mps2_an500"},
      {"mps3_an547", nullptr, {}, "", "", "mps3_an547"},
  };
  return rows;
}

const Recipe& find_recipe(const std::string& board) {
  const auto& rows = recipes();
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Recipe& row) { return row.board == board; });
  if (found != rows.end()) return *found;
  std::string names;
  for (const Recipe& row : rows) names += (names.empty() ? "" : ", ") + std::string(row.board);
  const std::string why =
      is_for_tests(board)
          ? fmt::format(
                "exists only in an emulator, where ./verp test --on {} walks it with a twin "
                "on CAN; there is nothing to flash",
                board)
          : "no such board";
  throw FlashError(FlashError::Kind::kUsage,
                   fmt::format("--board {}: {}; give one of: {}", board, why, names));
}

Span sectors_around(const Chip& chip, const Span& span) {
  std::uint32_t at = kFlashBegin, begin = 0, end = 0;
  for (const SectorRun& run : chip.sectors) {
    for (std::uint32_t i = 0; i < run.count; ++i, at += run.bytes) {
      if (!span.overlaps({at, run.bytes})) continue;
      if (end == 0) begin = at;
      end = at + run.bytes;
    }
  }
  return {begin, end - begin};
}

std::string dfu_layout(const Chip& chip) {
  std::string text;
  for (const SectorRun& run : chip.sectors) {
    text +=
        fmt::format("{}{:02}*{:03}Kg", text.empty() ? "" : ",", run.count, run.bytes / kKilobyte);
  }
  return text;
}

}  // namespace verp::flash
