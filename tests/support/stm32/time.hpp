#pragma once
#include <cstdint>

/// Simulated time of a chip model.
namespace verp::hal::stm32::model {

using Time = std::uint64_t;  ///< picoseconds since the model was made
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

__extension__ using Wide = unsigned __int128;

/// Whole periods of a clock that fit in a time, and the time (rounded up) that a number of periods
/// takes.
constexpr std::uint64_t periods(Time time, std::uint64_t hz) {
  return static_cast<std::uint64_t>(static_cast<Wide>(time) * hz / kSecond);
}
constexpr Time duration(std::uint64_t count, std::uint64_t hz) {
  return static_cast<Time>((static_cast<Wide>(count) * kSecond + hz - 1) / hz);
}

}  // namespace verp::hal::stm32::model
