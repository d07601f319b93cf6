#pragma once
#include <cstdint>

namespace verp::hal::stm32 {

enum class Family : std::uint8_t { kF405 = 0, kF446 = 1, kF746 = 2 };

/// `count` bits from bit `first` up.
constexpr std::uint32_t bits(unsigned first, unsigned count) {
  return (count >= 32u ? ~0u : (1u << count) - 1u) << first;
}
constexpr std::uint32_t bit(unsigned number) {
  return 1u << number;
}

}  // namespace verp::hal::stm32
