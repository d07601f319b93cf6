#pragma once
#include "hal/chip/stm32/registers/table.hpp"

/// Flash interface: wait states, programming and erasing.
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
/// The F4 calls bit 7 PGSERR, the F7 ERSERR: a control register that does not fit the write.
inline constexpr std::uint32_t kSrPgserr = bit(7), kSrRderrF446 = bit(8);
inline constexpr std::uint32_t kSrErrors = kSrOperr | kSrWrperr | kSrPgaerr | kSrPgperr | kSrPgserr;
inline constexpr std::uint32_t kCrPg = bit(0), kCrSer = bit(1), kCrMer = bit(2),
                               kCrSnb = bits(3, 4), kCrPsize = bits(8, 2), kCrStrt = bit(16),
                               kCrEopie = bit(24), kCrErrie = bit(25), kCrLock = bit(31);
inline constexpr unsigned kCrSnbShift = 3, kCrPsizeShift = 8;
/// PSIZE: the width of each write to the memory. 32 bits need 2.7 to 3.6 V.
inline constexpr std::uint32_t kPsize32 = 2;

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
