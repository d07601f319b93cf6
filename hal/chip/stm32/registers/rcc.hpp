#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// Reset and clock control (tables: rcc_tables.hpp).
namespace verp::hal::stm32::rcc {

inline constexpr std::uint32_t kCr = 0x00, kPllcfgr = 0x04, kCfgr = 0x08, kCir = 0x0C,
                               kAhb1rstr = 0x10, kAhb2rstr = 0x14, kAhb3rstr = 0x18,
                               kApb1rstr = 0x20, kApb2rstr = 0x24, kAhb1enr = 0x30, kAhb2enr = 0x34,
                               kAhb3enr = 0x38, kApb1enr = 0x40, kApb2enr = 0x44, kAhb1lpenr = 0x50,
                               kAhb2lpenr = 0x54, kAhb3lpenr = 0x58, kApb1lpenr = 0x60,
                               kApb2lpenr = 0x64, kBdcr = 0x70, kCsr = 0x74, kSscgr = 0x80,
                               kPlli2scfgr = 0x84;
/// Not on the F405.
inline constexpr std::uint32_t kPllsaicfgr = 0x88, kDckcfgr = 0x8C;
inline constexpr std::uint32_t kCkgatenrF446 = 0x90, kDckcfgr2F446 = 0x94, kDckcfgr2F746 = 0x90;

inline constexpr std::uint32_t kCrHsion = bit(0), kCrHsirdy = bit(1), kCrHsitrim = bits(3, 5),
                               kCrHsical = bits(8, 8), kCrHseon = bit(16), kCrHserdy = bit(17),
                               kCrHsebyp = bit(18), kCrCsson = bit(19), kCrPllon = bit(24),
                               kCrPllrdy = bit(25), kCrPlli2son = bit(26), kCrPlli2srdy = bit(27),
                               kCrPllsaion = bit(28), kCrPllsairdy = bit(29);
/// VCO = source / M * N; SYSCLK = VCO / (2 * (P + 1)); 48 MHz = VCO / Q.
inline constexpr std::uint32_t kPllcfgrM = bits(0, 6), kPllcfgrN = bits(6, 9),
                               kPllcfgrP = bits(16, 2), kPllcfgrSrcHse = bit(22),
                               kPllcfgrQ = bits(24, 4), kPllcfgrR = bits(28, 3);
inline constexpr unsigned kPllcfgrNShift = 6, kPllcfgrQShift = 24;
/// SW (requested) and SWS (in use).
inline constexpr std::uint32_t kClockHsi = 0, kClockHse = 1, kClockPll = 2;
inline constexpr std::uint32_t kCfgrSw = bits(0, 2), kCfgrSws = bits(2, 2), kCfgrHpre = bits(4, 4),
                               kCfgrPpre1 = bits(10, 3), kCfgrPpre2 = bits(13, 3),
                               kCfgrI2ssrc = bit(23);
inline constexpr unsigned kCfgrSwsShift = 2, kCfgrPpre1Shift = 10, kCfgrPpre2Shift = 13;
/// PPRE1 and PPRE2: divide by 2, by 4.
inline constexpr std::uint32_t kPpre2 = 4, kPpre4 = 5;

/// Enable bits. Reset bits are the same, except that ADC1's resets all three ADCs.
inline constexpr std::uint32_t kAhb1GpioA = bit(0);  ///< ports B, C, ... follow
inline constexpr std::uint32_t kAhb1Dma1 = bit(21), kAhb1Dma2 = bit(22);
inline constexpr std::uint32_t kAhb2OtgFs = bit(7);
inline constexpr std::uint32_t kApb1Tim2 = bit(0), kApb1Tim3 = bit(1), kApb1Tim4 = bit(2),
                               kApb1Tim5 = bit(3), kApb1Spi2 = bit(14), kApb1Spi3 = bit(15),
                               kApb1Usart2 = bit(17), kApb1Usart3 = bit(18), kApb1Uart4 = bit(19),
                               kApb1Uart5 = bit(20), kApb1Can1 = bit(25), kApb1Can2 = bit(26),
                               kApb1Pwr = bit(28);
/// F746 only.
inline constexpr std::uint32_t kApb1Uart7 = bit(30), kApb1Uart8 = bit(31);
inline constexpr std::uint32_t kApb2Usart1 = bit(4), kApb2Usart6 = bit(5), kApb2Adc1 = bit(8),
                               kApb2Adc2 = bit(9), kApb2Adc3 = bit(10), kApb2Spi1 = bit(12),
                               kApb2Syscfg = bit(14);

inline constexpr std::uint32_t kBdcrLseon = bit(0), kBdcrLserdy = bit(1), kBdcrRtcsel = bits(8, 2),
                               kBdcrRtcen = bit(15), kBdcrBdrst = bit(16);
inline constexpr std::uint32_t kCsrLsion = bit(0), kCsrLsirdy = bit(1), kCsrRmvf = bit(24),
                               kCsrBorrstf = bit(25), kCsrPinrstf = bit(26), kCsrPorrstf = bit(27),
                               kCsrSftrstf = bit(28), kCsrIwdgrstf = bit(29),
                               kCsrWwdgrstf = bit(30), kCsrLpwrrstf = bit(31);
/// DCKCFGR: timers at 4 times their bus clock, not 2, if its prescaler is 4 or more.
inline constexpr std::uint32_t kDckcfgrTimpre = bit(24);
/// DCKCFGR2 of F446 and F746: OTG_FS's 48 MHz from PLLSAI, not the main PLL's Q.
inline constexpr std::uint32_t kDckcfgr2Ck48msel = bit(27);
/// DCKCFGR2 of the F746, two bits per USART: 0 bus clock, 1 SYSCLK, 2 HSI, 3 LSE.
constexpr unsigned usart_clock_shift(unsigned usart_number) {
  return 2u * (usart_number - 1u);
}
}  // namespace verp::hal::stm32::rcc
