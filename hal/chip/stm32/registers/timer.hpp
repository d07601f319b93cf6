#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// TIM2 and TIM5 have 32 bits. TIM3 and TIM4 have 16 bits in CNT, ARR and CCRx, and no OR.
namespace verp::hal::stm32::timer {

inline constexpr std::uint32_t kCr1 = 0x00, kCr2 = 0x04, kSmcr = 0x08, kDier = 0x0C, kSr = 0x10,
                               kEgr = 0x14, kCcmr1 = 0x18, kCcmr2 = 0x1C, kCcer = 0x20, kCnt = 0x24,
                               kPsc = 0x28, kArr = 0x2C, kCcr1 = 0x34, kCcr2 = 0x38, kCcr3 = 0x3C,
                               kCcr4 = 0x40, kDcr = 0x48, kDmar = 0x4C, kOr = 0x50;

inline constexpr std::uint32_t kCr1Cen = bit(0), kCr1Udis = bit(1), kCr1Urs = bit(2),
                               kCr1Opm = bit(3), kCr1Dir = bit(4), kCr1Cms = bits(5, 2),
                               kCr1Arpe = bit(7);
inline constexpr std::uint32_t kDierUie = bit(0), kDierCc1ie = bit(1);
inline constexpr std::uint32_t kSrUif = bit(0), kSrCc1if = bit(1), kSrTif = bit(6),
                               kSrCcOf = bits(9, 4),
                               kSrAll = kSrUif | bits(1, 4) | kSrTif | kSrCcOf;
inline constexpr std::uint32_t kEgrUg = bit(0);

}  // namespace verp::hal::stm32::timer
