#pragma once
#include "hal/chip/stm32/registers/adc.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::adc {

constexpr Register word(const char* name, std::uint32_t offset, std::uint32_t paragraph,
                        unsigned width) {
  return {.name = name, .offset = offset, .paragraph = paragraph, .rw = bits(0, width)};
}
constexpr Register result(const char* name, std::uint32_t offset, std::uint32_t paragraph) {
  return {.name = name, .offset = offset, .paragraph = paragraph, .r = bits(0, 16)};
}

inline constexpr Register kRegisters[] = {
    {.name = "SR", .offset = kSr, .paragraph = 1, .rc_w0 = bits(0, 6)},
    {.name = "CR1", .offset = kCr1, .paragraph = 2, .rw = 0x07C0FFFF},
    {.name = "CR2", .offset = kCr2, .paragraph = 3, .rw = 0x7F7F0F03},
    word("SMPR1", kSmpr1, 4, 27),
    word("SMPR2", kSmpr2, 5, 30),
    word("JOFR1", kJofr1, 6, 12),
    word("JOFR2", kJofr1 + 4, 6, 12),
    word("JOFR3", kJofr1 + 8, 6, 12),
    word("JOFR4", kJofr1 + 12, 6, 12),
    {.name = "HTR", .offset = kHtr, .paragraph = 7, .reset = 0xFFF, .rw = bits(0, 12)},
    word("LTR", kLtr, 8, 12),
    word("SQR1", kSqr1, 9, 24),
    word("SQR2", kSqr2, 10, 30),
    word("SQR3", kSqr3, 11, 30),
    word("JSQR", kJsqr, 12, 22),
    result("JDR1", kJdr1, 13),
    result("JDR2", kJdr1 + 4, 13),
    result("JDR3", kJdr1 + 8, 13),
    result("JDR4", kJdr1 + 12, 13),
    {.name = "DR", .offset = kDr, .paragraph = 14, .r = bits(0, 16)},
};
inline constexpr Register kCommonRegisters[] = {
    {.name = "CSR", .offset = kCommonCsr, .paragraph = 15, .r = 0x003F3F3F},
    {.name = "CCR", .offset = kCommonCcr, .paragraph = 16, .rw = 0x00C3EF1F},
    {.name = "CDR", .offset = kCommonCdr, .paragraph = 17, .r = bits(0, 32)},
};
inline constexpr Table kTable =
    make_table("ADC", "RM0090 13.13, RM0390 13.13, RM0385 15.13", kRegisters);
inline constexpr Table kCommonTable =
    make_table("ADC common", "RM0090 13.13, RM0390 13.13, RM0385 15.13", kCommonRegisters);

}  // namespace verp::hal::stm32::adc
