#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// Regulator scale and overdrive; backup domain lock.
namespace verp::hal::stm32::pwr {

inline constexpr std::uint32_t kCr = 0x00, kCsr = 0x04;
inline constexpr std::uint32_t kCr2F746 = 0x08, kCsr2F746 = 0x0C;

inline constexpr std::uint32_t kCrDbp = bit(8), kCrVosF405 = bit(14), kCrVos = bits(14, 2),
                               kCrOden = bit(16), kCrOdswen = bit(17);
inline constexpr unsigned kCrVosShift = 14;
inline constexpr std::uint32_t kCsrVosrdy = bit(14), kCsrOdrdy = bit(16), kCsrOdswrdy = bit(17);

}  // namespace verp::hal::stm32::pwr
