#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// After a reset ports A and B have debug pins in use.
namespace verp::hal::stm32::gpio {

inline constexpr std::uint32_t kModer = 0x00, kOtyper = 0x04, kOspeedr = 0x08, kPupdr = 0x0C,
                               kIdr = 0x10, kOdr = 0x14, kBsrr = 0x18, kLckr = 0x1C, kAfrl = 0x20,
                               kAfrh = 0x24;

/// Two bits per pin.
inline constexpr std::uint32_t kModeInput = 0, kModeOutput = 1, kModeAlternate = 2, kModeAnalog = 3;
inline constexpr std::uint32_t kSpeedMedium = 1, kSpeedHigh = 2;
inline constexpr std::uint32_t kPullNone = 0, kPullUp = 1, kPullDown = 2;

}  // namespace verp::hal::stm32::gpio
