#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// Only the F7 has the window register.
namespace verp::hal::stm32::iwdg {

inline constexpr std::uint32_t kKr = 0x00, kPr = 0x04, kRlr = 0x08, kSr = 0x0C, kWinr = 0x10;

inline constexpr std::uint32_t kKeyUnlock = 0x5555, kKeyReload = 0xAAAA, kKeyStart = 0xCCCC;
/// LSI / (4 << PR); PR 7 divides like 6.
inline constexpr std::uint32_t kPrMax = 6, kRlrMax = 0xFFF;
inline constexpr std::uint32_t kSrPvu = bit(0), kSrRvu = bit(1), kSrWvu = bit(2);

}  // namespace verp::hal::stm32::iwdg
