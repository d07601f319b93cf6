#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// F4: reading SR and then DR clears flags. F7: a clear register does.
namespace verp::hal::stm32 {

namespace usart_v1 {

inline constexpr std::uint32_t kSr = 0x00, kDr = 0x04, kBrr = 0x08, kCr1 = 0x0C, kCr2 = 0x10,
                               kCr3 = 0x14, kGtpr = 0x18;

inline constexpr std::uint32_t kSrPe = bit(0), kSrFe = bit(1), kSrNf = bit(2), kSrOre = bit(3),
                               kSrIdle = bit(4), kSrRxne = bit(5), kSrTc = bit(6), kSrTxe = bit(7),
                               kSrLbd = bit(8), kSrCts = bit(9);
inline constexpr std::uint32_t kCr1Re = bit(2), kCr1Te = bit(3), kCr1Idleie = bit(4),
                               kCr1Rxneie = bit(5), kCr1Tcie = bit(6), kCr1Txeie = bit(7),
                               kCr1Peie = bit(8), kCr1Ps = bit(9), kCr1Pce = bit(10),
                               kCr1Wake = bit(11), kCr1M = bit(12), kCr1Ue = bit(13),
                               kCr1Over8 = bit(15);
inline constexpr std::uint32_t kCr2Stop = bits(12, 2);
inline constexpr std::uint32_t kCr3Eie = bit(0), kCr3Hdsel = bit(3), kCr3Dmar = bit(6),
                               kCr3Dmat = bit(7), kCr3Onebit = bit(11);

/// In SR a written 0 clears RXNE, TC, LBD or CTS; this value clears none.
inline constexpr std::uint32_t kSrKeep = kSrRxne | kSrTc | kSrLbd | kSrCts;

}  // namespace usart_v1

namespace usart_v2 {

inline constexpr std::uint32_t kCr1 = 0x00, kCr2 = 0x04, kCr3 = 0x08, kBrr = 0x0C, kGtpr = 0x10,
                               kRtor = 0x14, kRqr = 0x18, kIsr = 0x1C, kIcr = 0x20, kRdr = 0x24,
                               kTdr = 0x28;

inline constexpr std::uint32_t kCr1Ue = bit(0), kCr1Re = bit(2), kCr1Te = bit(3),
                               kCr1Idleie = bit(4), kCr1Rxneie = bit(5), kCr1Tcie = bit(6),
                               kCr1Txeie = bit(7), kCr1Peie = bit(8), kCr1Ps = bit(9),
                               kCr1Pce = bit(10), kCr1M0 = bit(12), kCr1Over8 = bit(15),
                               kCr1Dedt = bits(16, 5), kCr1Deat = bits(21, 5), kCr1M1 = bit(28);
inline constexpr std::uint32_t kCr2Stop = bits(12, 2);
inline constexpr std::uint32_t kCr3Eie = bit(0), kCr3Hdsel = bit(3), kCr3Dmar = bit(6),
                               kCr3Dmat = bit(7), kCr3Onebit = bit(11), kCr3Ovrdis = bit(12),
                               kCr3Ddre = bit(13), kCr3Dem = bit(14), kCr3Dep = bit(15);
inline constexpr std::uint32_t kRqrRxfrq = bit(3);
inline constexpr std::uint32_t kIsrBusy = bit(16), kIsrTeack = bit(21);
inline constexpr std::uint32_t kIcrPe = bit(0), kIcrFe = bit(1), kIcrNf = bit(2), kIcrOre = bit(3),
                               kIcrIdle = bit(4), kIcrTc = bit(6), kIcrLbd = bit(8),
                               kIcrCts = bit(9), kIcrRto = bit(11), kIcrEob = bit(12),
                               kIcrCm = bit(17);

}  // namespace usart_v2

}  // namespace verp::hal::stm32
