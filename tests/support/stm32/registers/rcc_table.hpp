#pragma once
#include "hal/chip/stm32/registers/rcc.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::rcc {

struct FamilyBits {
  std::uint32_t cr_rw = 0, cr_r = 0;  ///< of a second PLL
  std::uint32_t pllcfgr = 0;          ///< beyond the others'
  std::uint32_t no_cfgr = 0;          ///< reserved only here
  unsigned plls = 0;                  ///< with interrupts
  std::uint32_t ahb1_reset = 0, ahb1_clock = 0, ahb1_sleep = 0;
  std::uint32_t ahb2 = 0, ahb3 = 0, apb1 = 0;  ///< for reset, clock and sleep alike
  std::uint32_t apb2_reset = 0, apb2 = 0;
  std::uint32_t bdcr = 0;  ///< the LSE's modes
};

inline constexpr std::size_t kCommon = 22;
template <std::size_t kOwn>
struct Rows {
  Register row[kCommon + kOwn];
};

/// A register is a paragraph: those of all families, then the family's own.
template <std::size_t kOwn>
constexpr Rows<kOwn> rows(const FamilyBits& has, const Register (&own)[kOwn]) {
  Rows<kOwn> all = {{
      {.name = "CR",
       .offset = kCr,
       .reset = 0x00000083,
       .rw = kCrHsion | kCrHsitrim | kCrHseon | kCrHsebyp | kCrCsson | kCrPllon | kCrPlli2son |
             has.cr_rw,
       .r = kCrHsirdy | kCrHsical | kCrHserdy | kCrPllrdy | kCrPlli2srdy | has.cr_r},
      {.name = "PLLCFGR",
       .offset = kPllcfgr,
       .reset = 0x24003010,
       .rw = kPllcfgrM | kPllcfgrN | kPllcfgrP | kPllcfgrSrcHse | kPllcfgrQ | has.pllcfgr},
      {.name = "CFGR",
       .offset = kCfgr,
       .rw = bits(0, 32) & ~kCfgrSws & ~bits(8, 2) & ~has.no_cfgr,
       .r = kCfgrSws},
      {.name = "CIR",
       .offset = kCir,
       .rw = bits(8, has.plls),
       .r = bits(0, has.plls) | bit(7),
       .w = bits(16, has.plls) | bit(23)},
      {.name = "AHB1RSTR", .offset = kAhb1rstr, .rw = has.ahb1_reset},
      {.name = "AHB2RSTR", .offset = kAhb2rstr, .rw = has.ahb2},
      {.name = "AHB3RSTR", .offset = kAhb3rstr, .rw = has.ahb3},
      {.name = "APB1RSTR", .offset = kApb1rstr, .rw = has.apb1},
      {.name = "APB2RSTR", .offset = kApb2rstr, .rw = has.apb2_reset},
      {.name = "AHB1ENR", .offset = kAhb1enr, .reset = 0x00100000, .rw = has.ahb1_clock},
      {.name = "AHB2ENR", .offset = kAhb2enr, .rw = has.ahb2},
      {.name = "AHB3ENR", .offset = kAhb3enr, .rw = has.ahb3},
      {.name = "APB1ENR", .offset = kApb1enr, .rw = has.apb1},
      {.name = "APB2ENR", .offset = kApb2enr, .rw = has.apb2},
      {.name = "AHB1LPENR", .offset = kAhb1lpenr, .reset = has.ahb1_sleep, .rw = has.ahb1_sleep},
      {.name = "AHB2LPENR", .offset = kAhb2lpenr, .reset = has.ahb2, .rw = has.ahb2},
      {.name = "AHB3LPENR", .offset = kAhb3lpenr, .reset = has.ahb3, .rw = has.ahb3},
      {.name = "APB1LPENR", .offset = kApb1lpenr, .reset = has.apb1, .rw = has.apb1},
      {.name = "APB2LPENR", .offset = kApb2lpenr, .reset = has.apb2, .rw = has.apb2},
      {.name = "BDCR",
       .offset = kBdcr,
       .rw = kBdcrLseon | kBdcrRtcsel | kBdcrRtcen | kBdcrBdrst | has.bdcr,
       .r = kBdcrLserdy},
      {.name = "CSR",
       .offset = kCsr,
       .reset = 0x0E000000,
       .rw = kCsrLsion,
       .r = kCsrLsirdy | bits(25, 7),
       .w = kCsrRmvf},
      {.name = "SSCGR", .offset = kSscgr, .rw = 0xCFFFFFFF},
  }};
  for (std::size_t i = 0; i < kOwn; ++i) all.row[kCommon + i] = own[i];
  for (std::uint32_t i = 0; i < kCommon + kOwn; ++i) all.row[i].paragraph = i + 1;
  return all;
}

inline constexpr auto kRowsF405 =
    rows({.plls = 6,
          .ahb1_reset = 0x226011FF,
          .ahb1_clock = 0x7E7411FF,
          .ahb1_sleep = 0x7E6791FF,
          .ahb2 = 0x000000F1,
          .ahb3 = 0x00000001,
          .apb1 = 0x36FEC9FF,
          .apb2_reset = 0x00075933,
          .apb2 = 0x00075F33,
          .bdcr = bit(2)},
         {{.name = "PLLI2SCFGR", .offset = kPlli2scfgr, .reset = 0x20003000, .rw = 0x70007FC0}});
inline constexpr auto kRowsF446 =
    rows({.cr_rw = kCrPllsaion,
          .cr_r = kCrPllsairdy,
          .pllcfgr = kPllcfgrR,
          .no_cfgr = kCfgrI2ssrc,
          .plls = 7,
          .ahb1_reset = 0x206010FF,
          .ahb1_clock = 0x606410FF,
          .ahb1_sleep = 0x606790FF,
          .ahb2 = 0x00000081,
          .ahb3 = 0x00000003,
          .apb1 = 0x3FFFC9FF,
          .apb2_reset = 0x00C77933,
          .apb2 = 0x00C77F33,
          .bdcr = bits(2, 2)},
         {{.name = "PLLI2SCFGR", .offset = kPlli2scfgr, .reset = 0x24003010, .rw = 0x7F037FFF},
          {.name = "PLLSAICFGR", .offset = kPllsaicfgr, .reset = 0x04003010, .rw = 0x0F037FFF},
          {.name = "DCKCFGR", .offset = kDckcfgr, .rw = 0x1FF01F1F},
          {.name = "CKGATENR", .offset = kCkgatenrF446, .rw = bits(0, 7)},
          {.name = "DCKCFGR2", .offset = kDckcfgr2F446, .rw = 0x3CC00000}});
inline constexpr auto kRowsF746 =
    rows({.cr_rw = kCrPllsaion,
          .cr_r = kCrPllsairdy,
          .plls = 7,
          .ahb1_reset = 0x22E017FF,
          .ahb1_clock = 0x7EF417FF,
          .ahb1_sleep = 0x7EF7B7FF,
          .ahb2 = 0x000000F1,
          .ahb3 = 0x00000003,
          .apb1 = 0xFFFFCBFF,
          .apb2_reset = 0x04F77933,
          .apb2 = 0x04F77F33,
          .bdcr = bits(2, 3)},
         {{.name = "PLLI2SCFGR", .offset = kPlli2scfgr, .reset = 0x24003000, .rw = 0x7F037FC0},
          {.name = "PLLSAICFGR", .offset = kPllsaicfgr, .reset = 0x24003000, .rw = 0x7F037FC0},
          {.name = "DKCFGR1", .offset = kDckcfgr, .rw = 0x01F31F1F},
          {.name = "DKCFGR2", .offset = kDckcfgr2F746, .rw = bits(0, 29)}});

inline constexpr Table kTableF405 = make_table("RCC", "RM0090 7.3, -, -", kRowsF405.row);
inline constexpr Table kTableF446 = make_table("RCC", "-, RM0390 6.3, -", kRowsF446.row);
inline constexpr Table kTableF746 = make_table("RCC", "-, -, RM0385 5.3", kRowsF746.row);

constexpr const Table& table(Family family) {
  return family == Family::kF405 ? kTableF405 : family == Family::kF446 ? kTableF446 : kTableF746;
}

}  // namespace verp::hal::stm32::rcc
