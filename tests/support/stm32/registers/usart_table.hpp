#pragma once
#include "hal/chip/stm32/registers/usart.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32 {

namespace usart_v1 {

inline constexpr Register kRegisters[] = {
    // RM0090 prints 0x00C00000, but TXE and TC are 0xC0.
    {.name = "SR",
     .offset = kSr,
     .paragraph = 1,
     .reset = 0xC0,
     .r = kSrPe | kSrFe | kSrNf | kSrOre | kSrIdle | kSrTxe,
     .rc_w0 = kSrKeep},
    {.name = "DR", .offset = kDr, .paragraph = 2, .rw = bits(0, 9)},
    {.name = "BRR", .offset = kBrr, .paragraph = 3, .rw = bits(0, 16)},
    {.name = "CR1", .offset = kCr1, .paragraph = 4, .rw = 0xBFFF},
    {.name = "CR2", .offset = kCr2, .paragraph = 5, .rw = 0x7F6F},
    {.name = "CR3", .offset = kCr3, .paragraph = 6, .rw = bits(0, 12)},
    {.name = "GTPR", .offset = kGtpr, .paragraph = 7, .rw = bits(0, 16)},
};
inline constexpr Table kTable = make_table("USART", "RM0090 30.6, RM0390 25.6, -", kRegisters);

}  // namespace usart_v1

namespace usart_v2 {

inline constexpr Register kRegisters[] = {
    {.name = "CR1", .offset = kCr1, .paragraph = 1, .rw = bits(0, 29) & ~bit(1)},
    {.name = "CR2", .offset = kCr2, .paragraph = 2, .rw = 0xFFFFFF70},
    {.name = "CR3", .offset = kCr3, .paragraph = 3, .rw = 0x000EFFFF},
    {.name = "BRR", .offset = kBrr, .paragraph = 4, .rw = bits(0, 16)},
    {.name = "GTPR", .offset = kGtpr, .paragraph = 5, .rw = bits(0, 16)},
    {.name = "RTOR", .offset = kRtor, .paragraph = 6, .rw = bits(0, 32)},
    {.name = "RQR", .offset = kRqr, .paragraph = 7, .w = bits(0, 5)},
    {.name = "ISR", .offset = kIsr, .paragraph = 8, .reset = 0xC0, .r = 0x002FDFFF},
    {.name = "ICR",
     .offset = kIcr,
     .paragraph = 9,
     .w = kIcrPe | kIcrFe | kIcrNf | kIcrOre | kIcrIdle | kIcrTc | kIcrLbd | kIcrCts | kIcrRto |
          kIcrEob | kIcrCm},
    {.name = "RDR", .offset = kRdr, .paragraph = 10, .r = bits(0, 9)},
    {.name = "TDR", .offset = kTdr, .paragraph = 11, .rw = bits(0, 9)},
};
inline constexpr Table kTable = make_table("USART", "-, -, RM0385 31.8", kRegisters);

}  // namespace usart_v2

}  // namespace verp::hal::stm32
