#pragma once
#include "hal/chip/stm32/registers/iwdg.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::iwdg {

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
