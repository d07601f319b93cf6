#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// The F7 has 4-byte FIFOs: access DR with 8 bits for frames of up to 8 bits (a wider access packs
/// two frames), and set FRXTH so that one byte sets RXNE.
namespace verp::hal::stm32::spi {

inline constexpr std::uint32_t kCr1 = 0x00, kCr2 = 0x04, kSr = 0x08, kDr = 0x0C, kCrcpr = 0x10,
                               kRxcrcr = 0x14, kTxcrcr = 0x18, kI2scfgr = 0x1C, kI2spr = 0x20;

inline constexpr std::uint32_t kCr1Cpha = bit(0), kCr1Cpol = bit(1), kCr1Mstr = bit(2),
                               kCr1Br = bits(3, 3), kCr1Spe = bit(6), kCr1Lsbfirst = bit(7),
                               kCr1Ssi = bit(8), kCr1Ssm = bit(9), kCr1Rxonly = bit(10),
                               kCr1DffF4 = bit(11), kCr1Crcen = bit(13), kCr1Bidimode = bit(15);
/// SCK = bus clock / (2 << BR).
inline constexpr unsigned kCr1BrShift = 3;
inline constexpr std::uint32_t kCr2Rxdmaen = bit(0), kCr2Txdmaen = bit(1), kCr2Ssoe = bit(2),
                               kCr2Errie = bit(5), kCr2Rxneie = bit(6), kCr2Txeie = bit(7);
inline constexpr std::uint32_t kCr2DsF7 = bits(8, 4), kCr2Ds8BitF7 = 7u << 8, kCr2FrxthF7 = bit(12);
inline constexpr std::uint32_t kSrRxne = bit(0), kSrTxe = bit(1), kSrCrcerr = bit(4),
                               kSrModf = bit(5), kSrOvr = bit(6), kSrBsy = bit(7), kSrFre = bit(8);
inline constexpr std::uint32_t kSrFrlvlF7 = bits(9, 2), kSrFtlvlF7 = bits(11, 2);

}  // namespace verp::hal::stm32::spi
