#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// DMA1 and DMA2: 8 streams each, the same in all three families.
namespace verp::hal::stm32::dma {

inline constexpr std::uint32_t kLisr = 0x00, kHisr = 0x04, kLifcr = 0x08, kHifcr = 0x0C;
inline constexpr std::uint32_t kStreams = 8;

/// Stream 0; stream s is at s * kStreamStep.
inline constexpr std::uint32_t kCr = 0x10, kNdtr = 0x14, kPar = 0x18, kM0ar = 0x1C, kM1ar = 0x20,
                               kFcr = 0x24, kStreamStep = 0x18;

inline constexpr std::uint32_t kCrEn = bit(0), kCrDmeie = bit(1), kCrTeie = bit(2),
                               kCrHtie = bit(3), kCrTcie = bit(4), kCrDir = bits(6, 2),
                               kCrDirToPeripheral = bit(6), kCrCirc = bit(8), kCrPinc = bit(9),
                               kCrMinc = bit(10), kCrPsize = bits(11, 2), kCrMsize = bits(13, 2),
                               kCrPl = bits(16, 2), kCrDbm = bit(18), kCrCt = bit(19),
                               kCrChsel = bits(25, 3);
inline constexpr unsigned kCrChselShift = 25;
inline constexpr std::uint32_t kFcrFth = bits(0, 2), kFcrDmdis = bit(2), kFcrFs = bits(3, 3),
                               kFcrFeie = bit(7);

/// A stream's flags in LISR (streams 0 to 3) or HISR (4 to 7), cleared in LIFCR or HIFCR; shift by
/// flag_shift().
inline constexpr std::uint32_t kFlagFe = bit(0), kFlagDme = bit(2), kFlagTe = bit(3),
                               kFlagHt = bit(4), kFlagTc = bit(5),
                               kFlagAll = kFlagFe | kFlagDme | kFlagTe | kFlagHt | kFlagTc;
constexpr unsigned flag_shift(std::uint32_t stream) {
  constexpr unsigned kShift[] = {0, 6, 16, 22};
  return kShift[stream & 3u];
}
constexpr std::uint32_t status_offset(std::uint32_t stream) {
  return stream < 4 ? kLisr : kHisr;
}
constexpr std::uint32_t clear_offset(std::uint32_t stream) {
  return stream < 4 ? kLifcr : kHifcr;
}

}  // namespace verp::hal::stm32::dma
