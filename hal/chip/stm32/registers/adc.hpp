#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// ADCs, the same in all three families.
namespace verp::hal::stm32::adc {

inline constexpr std::uint32_t kSr = 0x00, kCr1 = 0x04, kCr2 = 0x08, kSmpr1 = 0x0C, kSmpr2 = 0x10,
                               kJofr1 = 0x14, kHtr = 0x24, kLtr = 0x28, kSqr1 = 0x2C, kSqr2 = 0x30,
                               kSqr3 = 0x34, kJsqr = 0x38, kJdr1 = 0x3C, kDr = 0x4C;
/// From the base of the shared registers.
inline constexpr std::uint32_t kCommonCsr = 0x00, kCommonCcr = 0x04, kCommonCdr = 0x08;

inline constexpr std::uint32_t kSrEoc = bit(1), kSrStrt = bit(4), kSrOvr = bit(5);
inline constexpr std::uint32_t kCr2Adon = bit(0), kCr2Cont = bit(1), kCr2Swstart = bit(30);
inline constexpr std::uint32_t kCcrAdcpre = bits(16, 2);
inline constexpr unsigned kCcrAdcpreShift = 16;  ///< ADC clock = APB2 / (2 * (ADCPRE + 1))

}  // namespace verp::hal::stm32::adc
