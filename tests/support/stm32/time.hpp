#pragma once
#include <cstdint>

namespace verp::hal::stm32::model {

using Time = std::uint64_t;  ///< picoseconds
inline constexpr Time kNever = ~Time{0};
inline constexpr Time kSecond = 1'000'000'000'000;

constexpr Time ns(std::uint64_t count) {
  return count * 1'000;
}
constexpr Time us(std::uint64_t count) {
  return count * 1'000'000;
}
constexpr Time ms(std::uint64_t count) {
  return count * 1'000'000'000;
}

/// Whole periods in a time, and the time (rounded up) of periods. The product exceeds 64 bits, so
/// both divide in steps; hz is up to 10^9.
constexpr std::uint64_t periods(Time time, std::uint64_t hz) {
  constexpr Time kMicrosecond = us(1);
  const Time part = time % kSecond;
  const std::uint64_t millionths =
      part / kMicrosecond * hz + part % kMicrosecond * hz / kMicrosecond;
  return time / kSecond * hz + millionths / 1'000'000;
}
constexpr Time duration(std::uint64_t count, std::uint64_t hz) {
  const std::uint64_t part_us = count % hz * 1'000'000;
  return count / hz * kSecond + us(part_us / hz) + (us(part_us % hz) + hz - 1) / hz;
}

}  // namespace verp::hal::stm32::model
