#pragma once
#include <cstdint>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/usart.hpp"

namespace verp::hal::stm32 {

/// Flags at the same place in SR and ISR.
namespace usart_flag {
inline constexpr std::uint32_t kParity = bit(0), kFraming = bit(1), kNoise = bit(2),
                               kOverrun = bit(3), kIdle = bit(4), kReceived = bit(5),
                               kSent = bit(6), kRoom = bit(7);
inline constexpr std::uint32_t kErrors = kParity | kFraming | kNoise | kOverrun;
}  // namespace usart_flag
inline constexpr int kNoByte = -1;

/// F4: reading SR and then DR clears errors and IDLE.
struct UsartV1 {
  static constexpr std::uint32_t kStatus = usart_v1::kSr, kReceive = usart_v1::kDr,
                                 kTransmit = usart_v1::kDr, kBrr = usart_v1::kBrr,
                                 kCr1 = usart_v1::kCr1, kCr2 = usart_v1::kCr2,
                                 kCr3 = usart_v1::kCr3;
  static constexpr std::uint32_t kEnable = usart_v1::kCr1Ue;

  /// `status` was just read. A waiting byte's reader clears the flags. Else returns the byte that
  /// came last: if it came after `status`, its DMA stream misses it.
  template <Io Access>
  static int clear(Access& io, std::uint32_t base, std::uint32_t status) {
    if ((status & usart_flag::kReceived) != 0) return kNoByte;
    return static_cast<std::uint8_t>(io.read32(base + kReceive));
  }
};

/// F7: ICR clears the flags.
struct UsartV2 {
  static constexpr std::uint32_t kStatus = usart_v2::kIsr, kReceive = usart_v2::kRdr,
                                 kTransmit = usart_v2::kTdr, kBrr = usart_v2::kBrr,
                                 kCr1 = usart_v2::kCr1, kCr2 = usart_v2::kCr2,
                                 kCr3 = usart_v2::kCr3;
  static constexpr std::uint32_t kEnable = usart_v2::kCr1Ue;

  template <Io Access>
  static int clear(Access& io, std::uint32_t base, std::uint32_t status) {
    io.write32(base + usart_v2::kIcr, status & (usart_flag::kErrors | usart_flag::kIdle));
    return kNoByte;
  }
};
static_assert(usart_v1::kCr1Over8 == usart_v2::kCr1Over8 && usart_v1::kCr1Te == usart_v2::kCr1Te &&
              usart_v1::kCr1Re == usart_v2::kCr1Re && usart_v1::kCr3Eie == usart_v2::kCr3Eie &&
              usart_v1::kCr3Dmar == usart_v2::kCr3Dmar);

struct BaudSetting {
  std::uint32_t brr = 0;
  bool over8 = false;
};

/// False: no divider within 1 %. Start, stop and eight data bits tolerate about 4 % between the two
/// ends (RM0090 30.3.5); the internal oscillator may use up one.
constexpr bool choose_baud(std::uint32_t clock_hz, std::uint32_t baud, BaudSetting& setting) {
  if (baud == 0 || baud > clock_hz / 8) return false;
  const std::uint32_t divider = (clock_hz + baud / 2) / baud;  // cycles a bit
  if (divider > 0xFFFF) return false;
  const std::uint64_t real = std::uint64_t{divider} * baud;
  const std::uint64_t off = real > clock_hz ? real - clock_hz : clock_hz - real;
  if (off * 100 > clock_hz) return false;
  setting.over8 = divider < 16;
  setting.brr = setting.over8 ? (divider >> 3) << 4 | (divider & 7u) : divider;
  return true;
}

}  // namespace verp::hal::stm32
