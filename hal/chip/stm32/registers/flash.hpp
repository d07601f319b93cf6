#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

namespace verp::hal::stm32::flash {

inline constexpr std::uint32_t kAcr = 0x00, kKeyr = 0x04, kOptkeyr = 0x08, kSr = 0x0C, kCr = 0x10,
                               kOptcr = 0x14, kOptcr1F746 = 0x18;

inline constexpr std::uint32_t kKey1 = 0x45670123, kKey2 = 0xCDEF89AB;
inline constexpr std::uint32_t kOptKey1 = 0x08192A3B, kOptKey2 = 0x4C5D6E7F;

inline constexpr std::uint32_t kAcrLatencyF405 = bits(0, 3), kAcrLatency = bits(0, 4),
                               kAcrPrften = bit(8);
inline constexpr std::uint32_t kAcrIcenF4 = bit(9), kAcrDcenF4 = bit(10), kAcrIcrstF4 = bit(11),
                               kAcrDcrstF4 = bit(12);
inline constexpr std::uint32_t kAcrArtenF7 = bit(9), kAcrArtrstF7 = bit(11);
inline constexpr std::uint32_t kSrEop = bit(0), kSrOperr = bit(1), kSrWrperr = bit(4),
                               kSrPgaerr = bit(5), kSrPgperr = bit(6), kSrBsy = bit(16);
/// Bit 7 (F4: PGSERR, F7: ERSERR): the control register does not match the write.
inline constexpr std::uint32_t kSrPgserr = bit(7), kSrRderrF446 = bit(8);
inline constexpr std::uint32_t kSrErrors = kSrOperr | kSrWrperr | kSrPgaerr | kSrPgperr | kSrPgserr;
inline constexpr std::uint32_t kCrPg = bit(0), kCrSer = bit(1), kCrMer = bit(2),
                               kCrSnb = bits(3, 4), kCrPsize = bits(8, 2), kCrStrt = bit(16),
                               kCrEopie = bit(24), kCrErrie = bit(25), kCrLock = bit(31);
inline constexpr std::uint32_t kOptcrOptlock = bit(0), kOptcrOptstrt = bit(1),
                               kOptcrBorLev = bits(2, 2);
inline constexpr unsigned kCrSnbShift = 3, kCrPsizeShift = 8;
/// PSIZE; 32 bits need 2.7 to 3.6 V.
inline constexpr std::uint32_t kPsize32 = 2;

}  // namespace verp::hal::stm32::flash
