#pragma once
#include "hal/chip/stm32/registers/dma.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::dma {

inline constexpr std::uint32_t kFlagsOfFour =
    kFlagAll | (kFlagAll << 6) | (kFlagAll << 16) | (kFlagAll << 22);

/// Those of all streams, then stream 0's.
inline constexpr Register kRegisters[] = {
    {.name = "LISR", .offset = kLisr, .paragraph = 1, .r = kFlagsOfFour},
    {.name = "HISR", .offset = kHisr, .paragraph = 2, .r = kFlagsOfFour},
    {.name = "LIFCR", .offset = kLifcr, .paragraph = 3, .w = kFlagsOfFour},
    {.name = "HIFCR", .offset = kHifcr, .paragraph = 4, .w = kFlagsOfFour},
};
inline constexpr Register kStreamRegisters[] = {
    {.name = "SxCR", .offset = kCr, .paragraph = 5, .rw = bits(0, 28) & ~bit(20)},
    {.name = "SxNDTR", .offset = kNdtr, .paragraph = 6, .rw = bits(0, 16)},
    {.name = "SxPAR", .offset = kPar, .paragraph = 7, .rw = bits(0, 32)},
    {.name = "SxM0AR", .offset = kM0ar, .paragraph = 8, .rw = bits(0, 32)},
    {.name = "SxM1AR", .offset = kM1ar, .paragraph = 9, .rw = bits(0, 32)},
    {.name = "SxFCR",
     .offset = kFcr,
     .paragraph = 10,
     .reset = 0x21,
     .rw = kFcrFth | kFcrDmdis | kFcrFeie,
     .r = kFcrFs},
};
inline constexpr Table kTable =
    make_table("DMA", "RM0090 10.5, RM0390 9.5, RM0385 8.5", kRegisters);
inline constexpr Table kStreamTable =
    make_table("DMA stream", "RM0090 10.5, RM0390 9.5, RM0385 8.5", kStreamRegisters);

}  // namespace verp::hal::stm32::dma
