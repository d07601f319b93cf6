#pragma once
#include "hal/chip/stm32/registers/gpio.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::gpio {

inline constexpr std::uint32_t kModerResetA = 0xA8000000, kModerResetB = 0x00000280,
                               kOspeedrResetA = 0x0C000000, kOspeedrResetB = 0x000000C0,
                               kPupdrResetA = 0x64000000, kPupdrResetB = 0x00000100;

/// For ports C and up.
inline constexpr Register kRegisters[] = {
    {.name = "MODER", .offset = kModer, .paragraph = 1, .rw = bits(0, 32)},
    {.name = "OTYPER", .offset = kOtyper, .paragraph = 2, .rw = bits(0, 16)},
    {.name = "OSPEEDR", .offset = kOspeedr, .paragraph = 3, .rw = bits(0, 32)},
    {.name = "PUPDR", .offset = kPupdr, .paragraph = 4, .rw = bits(0, 32)},
    {.name = "IDR", .offset = kIdr, .paragraph = 5, .r = bits(0, 16)},
    {.name = "ODR", .offset = kOdr, .paragraph = 6, .rw = bits(0, 16)},
    {.name = "BSRR", .offset = kBsrr, .paragraph = 7, .w = bits(0, 32)},
    {.name = "LCKR", .offset = kLckr, .paragraph = 8, .rw = bits(0, 17)},
    {.name = "AFRL", .offset = kAfrl, .paragraph = 9, .rw = bits(0, 32)},
    {.name = "AFRH", .offset = kAfrh, .paragraph = 10, .rw = bits(0, 32)},
};
inline constexpr Table kTable =
    make_table("GPIO", "RM0090 8.4, RM0390 7.4, RM0385 6.4", kRegisters);

}  // namespace verp::hal::stm32::gpio
