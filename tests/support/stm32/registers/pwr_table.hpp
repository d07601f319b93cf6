#pragma once
#include "hal/chip/stm32/registers/pwr.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::pwr {

inline constexpr Register kRegistersF405[] = {
    {.name = "CR",
     .offset = kCr,
     .paragraph = 1,
     .reset = 0x00004000,
     .rw = bits(0, 2) | bits(4, 6) | kCrVosF405,
     .w = bits(2, 2)},
    {.name = "CSR", .offset = kCsr, .paragraph = 2, .rw = bits(8, 2), .r = bits(0, 4) | kCsrVosrdy},
};
inline constexpr Register kRegistersF446[] = {
    {.name = "CR",
     .offset = kCr,
     .paragraph = 1,
     .reset = 0x0000C000,
     .rw = bits(0, 2) | bits(4, 8) | bits(13, 9),
     .w = bits(2, 2)},
    {.name = "CSR",
     .offset = kCsr,
     .paragraph = 2,
     .rw = bits(7, 3),
     .r = bits(0, 4) | kCsrVosrdy | kCsrOdrdy | kCsrOdswrdy,
     .rc_w1 = bits(18, 2)},
};
inline constexpr Register kRegistersF746[] = {
    {.name = "CR1",
     .offset = kCr,
     .paragraph = 1,
     .reset = 0x0000C000,
     .rw = bits(0, 2) | bits(4, 8) | bits(13, 7),
     .w = bit(3)},
    {.name = "CSR1",
     .offset = kCsr,
     .paragraph = 2,
     .rw = bits(8, 2),
     .r = bits(0, 4) | kCsrVosrdy | kCsrOdrdy | kCsrOdswrdy,
     .rc_w1 = bits(18, 2)},
    {.name = "CR2", .offset = kCr2F746, .paragraph = 3, .rw = bits(8, 6), .w = bits(0, 6)},
    {.name = "CSR2", .offset = kCsr2F746, .paragraph = 4, .rw = bits(8, 6), .r = bits(0, 6)},
};
inline constexpr Table kTableF405 = make_table("PWR", "RM0090 5.4, -, -", kRegistersF405);
inline constexpr Table kTableF446 = make_table("PWR", "-, RM0390 5.4, -", kRegistersF446);
inline constexpr Table kTableF746 = make_table("PWR", "-, -, RM0385 4.4", kRegistersF746);

constexpr const Table& table(Family family) {
  return family == Family::kF405 ? kTableF405 : family == Family::kF446 ? kTableF446 : kTableF746;
}

}  // namespace verp::hal::stm32::pwr
