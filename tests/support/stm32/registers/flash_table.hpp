#pragma once
#include "hal/chip/stm32/registers/flash.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::flash {

constexpr Register acr(std::uint32_t paragraph, std::uint32_t rw, std::uint32_t w) {
  return {.name = "ACR", .offset = kAcr, .paragraph = paragraph, .rw = rw, .w = w};
}
constexpr Register key(const char* name, std::uint32_t offset, std::uint32_t paragraph) {
  return {.name = name, .offset = offset, .paragraph = paragraph, .w = bits(0, 32)};
}
constexpr Register status(std::uint32_t paragraph, std::uint32_t more) {
  return {.name = "SR",
          .offset = kSr,
          .paragraph = paragraph,
          .r = kSrBsy,
          .rc_w1 = kSrEop | kSrErrors | more};
}
constexpr Register control(std::uint32_t paragraph) {
  return {.name = "CR",
          .offset = kCr,
          .paragraph = paragraph,
          .reset = 0x80000000,
          .rw = kCrPg | kCrSer | kCrMer | kCrSnb | kCrPsize | kCrEopie | kCrErrie,
          .rs = kCrStrt | kCrLock};
}
constexpr Register option(std::uint32_t paragraph, std::uint32_t reset, std::uint32_t rw) {
  return {.name = "OPTCR",
          .offset = kOptcr,
          .paragraph = paragraph,
          .reset = reset,
          .rw = rw,
          .rs = bits(0, 2)};
}

inline constexpr Register kRegistersF405[] = {
    acr(1, kAcrLatencyF405 | kAcrPrften | kAcrIcenF4 | kAcrDcenF4 | kAcrDcrstF4, kAcrIcrstF4),
    key("KEYR", kKeyr, 3),
    key("OPTKEYR", kOptkeyr, 4),
    status(5, 0),
    control(7),
    option(9, 0x0FFFAAED, bits(2, 2) | bits(5, 23)),
};
inline constexpr Register kRegistersF446[] = {
    acr(1, kAcrLatency | kAcrPrften | kAcrIcenF4 | kAcrDcenF4 | kAcrDcrstF4, kAcrIcrstF4),
    key("KEYR", kKeyr, 2),
    key("OPTKEYR", kOptkeyr, 3),
    status(4, kSrRderrF446),
    control(5),
    option(6, 0x0FFFAAED, bits(2, 2) | bits(5, 19) | bit(31)),
};
inline constexpr Register kRegistersF746[] = {
    acr(1, kAcrLatency | kAcrPrften | kAcrArtenF7 | kAcrArtrstF7, 0),
    key("KEYR", kKeyr, 2),
    key("OPTKEYR", kOptkeyr, 3),
    status(4, 0),
    control(5),
    option(6, 0xC0FFAAFD, bits(2, 22) | bits(30, 2)),
    {.name = "OPTCR1",
     .offset = kOptcr1F746,
     .paragraph = 7,
     .reset = 0x00400080,
     .rw = bits(0, 32)},
};
inline constexpr Table kTableF405 = make_table("FLASH", "RM0090 3.9, -, -", kRegistersF405);
inline constexpr Table kTableF446 = make_table("FLASH", "-, RM0390 3.8, -", kRegistersF446);
inline constexpr Table kTableF746 = make_table("FLASH", "-, -, RM0385 3.7", kRegistersF746);

constexpr const Table& table(Family family) {
  return family == Family::kF405 ? kTableF405 : family == Family::kF446 ? kTableF446 : kTableF746;
}

}  // namespace verp::hal::stm32::flash
