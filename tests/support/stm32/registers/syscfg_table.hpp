#pragma once
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32 {

namespace syscfg {

inline constexpr std::uint32_t kMemrmp = 0x00, kPmc = 0x04, kExticr1 = 0x08, kCmpcr = 0x20,
                               kCfgrF446 = 0x2C;

constexpr Register exticr(const char* name, std::uint32_t index) {
  return {.name = name, .offset = kExticr1 + 4 * index, .paragraph = 3 + index, .rw = bits(0, 16)};
}
inline constexpr Register kCmpcrRegister = {
    .name = "CMPCR", .offset = kCmpcr, .paragraph = 7, .rw = bit(0), .r = bit(8)};

/// MEMRMP follows the boot pins; this is a start from flash.
inline constexpr Register kRegistersF405[] = {
    {.name = "MEMRMP", .offset = kMemrmp, .paragraph = 1, .rw = bits(0, 2)},
    {.name = "PMC", .offset = kPmc, .paragraph = 2, .rw = bit(23)},
    exticr("EXTICR1", 0),
    exticr("EXTICR2", 1),
    exticr("EXTICR3", 2),
    exticr("EXTICR4", 3),
    kCmpcrRegister,
};
inline constexpr Register kRegistersF446[] = {
    {.name = "MEMRMP", .offset = kMemrmp, .paragraph = 1, .rw = bits(0, 3) | bits(10, 2)},
    {.name = "PMC", .offset = kPmc, .paragraph = 2, .rw = bits(16, 3)},
    exticr("EXTICR1", 0),
    exticr("EXTICR2", 1),
    exticr("EXTICR3", 2),
    exticr("EXTICR4", 3),
    kCmpcrRegister,
    {.name = "CFGR", .offset = kCfgrF446, .paragraph = 8, .rw = bits(0, 2)},
};
inline constexpr Register kRegistersF746[] = {
    {.name = "MEMRMP", .offset = kMemrmp, .paragraph = 1, .rw = bits(10, 2), .r = bit(0)},
    {.name = "PMC", .offset = kPmc, .paragraph = 2, .rw = bits(16, 3) | bit(23)},
    exticr("EXTICR1", 0),
    exticr("EXTICR2", 1),
    exticr("EXTICR3", 2),
    exticr("EXTICR4", 3),
    kCmpcrRegister,
};
inline constexpr Table kTableF405 = make_table("SYSCFG", "RM0090 9.2, -, -", kRegistersF405);
inline constexpr Table kTableF446 = make_table("SYSCFG", "-, RM0390 8.2, -", kRegistersF446);
inline constexpr Table kTableF746 = make_table("SYSCFG", "-, -, RM0385 7.2", kRegistersF746);

constexpr const Table& table(Family family) {
  return family == Family::kF405 ? kTableF405 : family == Family::kF446 ? kTableF446 : kTableF746;
}

}  // namespace syscfg

namespace exti {

inline constexpr std::uint32_t kImr = 0x00, kEmr = 0x04, kRtsr = 0x08, kFtsr = 0x0C, kSwier = 0x10,
                               kPr = 0x14;

constexpr Register lines(const char* name, std::uint32_t offset, std::uint32_t paragraph,
                         unsigned count) {
  return {.name = name, .offset = offset, .paragraph = paragraph, .rw = bits(0, count)};
}
inline constexpr Register kRegistersF4[] = {
    lines("IMR", kImr, 1, 23),
    lines("EMR", kEmr, 2, 23),
    lines("RTSR", kRtsr, 3, 23),
    lines("FTSR", kFtsr, 4, 23),
    lines("SWIER", kSwier, 5, 23),
    {.name = "PR", .offset = kPr, .paragraph = 6, .rc_w1 = bits(0, 23)},
};
inline constexpr Register kRegistersF7[] = {
    lines("IMR", kImr, 1, 24),
    lines("EMR", kEmr, 2, 24),
    lines("RTSR", kRtsr, 3, 24),
    lines("FTSR", kFtsr, 4, 24),
    lines("SWIER", kSwier, 5, 24),
    {.name = "PR", .offset = kPr, .paragraph = 6, .rc_w1 = bits(0, 24)},
};
inline constexpr Table kTable = make_table("EXTI", "RM0090 12.3, RM0390 10.3, -", kRegistersF4);
inline constexpr Table kTableF7 = make_table("EXTI", "-, -, RM0385 11.9", kRegistersF7);

}  // namespace exti

}  // namespace verp::hal::stm32
