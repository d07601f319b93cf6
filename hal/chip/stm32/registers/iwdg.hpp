#pragma once
#include "hal/chip/stm32/registers/table.hpp"

/// Independent watchdog. The window register is the F7's.
namespace verp::hal::stm32::iwdg {

inline constexpr std::uint32_t kKr = 0x00, kPr = 0x04, kRlr = 0x08, kSr = 0x0C, kWinr = 0x10;

inline constexpr std::uint32_t kKeyUnlock = 0x5555, kKeyReload = 0xAAAA, kKeyStart = 0xCCCC;
/// The counter runs at LSI / (4 << PR); 7 divides as 6 does.
inline constexpr std::uint32_t kPrMax = 6, kRlrMax = 0xFFF;
inline constexpr std::uint32_t kSrPvu = bit(0), kSrRvu = bit(1), kSrWvu = bit(2);

inline constexpr Register kRegisters[] = {
    {.name = "KR", .offset = kKr, .paragraph = 1, .w = bits(0, 16)},
    {.name = "PR", .offset = kPr, .paragraph = 2, .rw = bits(0, 3)},
    {.name = "RLR", .offset = kRlr, .paragraph = 3, .reset = 0xFFF, .rw = bits(0, 12)},
    {.name = "SR", .offset = kSr, .paragraph = 4, .r = kSrPvu | kSrRvu},
};
inline constexpr Register kRegistersF7[] = {
    {.name = "KR", .offset = kKr, .paragraph = 1, .w = bits(0, 16)},
    {.name = "PR", .offset = kPr, .paragraph = 2, .rw = bits(0, 3)},
    {.name = "RLR", .offset = kRlr, .paragraph = 3, .reset = 0xFFF, .rw = bits(0, 12)},
    {.name = "SR", .offset = kSr, .paragraph = 4, .r = kSrPvu | kSrRvu | kSrWvu},
    {.name = "WINR", .offset = kWinr, .paragraph = 5, .reset = 0xFFF, .rw = bits(0, 12)},
};
inline constexpr Table kTable = make_table("IWDG", "RM0090 21.4, RM0390 20.4, -", kRegisters);
inline constexpr Table kTableF7 = make_table("IWDG", "-, -, RM0385 25.4", kRegistersF7);

}  // namespace verp::hal::stm32::iwdg
