#pragma once
#include <bit>
#include <cstdint>
#include <limits>

#include "common/math/scalar.hpp"

/// Float to integer and back: nearest, ties to even, saturating, NaN gives 0. Processors disagree
/// on out-of-range casts, so only this file casts float to integer.
namespace verp::math {

/// Nearest integral float. NaN gives 0; infinities and the sign of zero stay.
constexpr float round_even(float x) {
  const float size = abs(x);
  if (!(size < 8388608.0F)) return x == x ? x : 0.0F;  // 2^23: no fraction left
  return copysign((size + 8388608.0F) - 8388608.0F, x);
}

/// Integers of at most 64 bits. Monotonic.
template <class Integer>
constexpr Integer round_to(float x) {
  using Limits = std::numeric_limits<Integer>;
  static_assert(Limits::is_integer && sizeof(Integer) <= 8);
  // Below 2^22, adding 1.5 * 2^23 leaves the integer in the last bits.
  if (sizeof(Integer) == 4 && Limits::is_signed && abs(x) < 4194304.0F) {
    constexpr float kShift = 12582912.0F;
    return static_cast<Integer>(std::bit_cast<std::int32_t>(x + kShift) -
                                std::bit_cast<std::int32_t>(kShift));
  }
  // max() + 1, a power of two, hence exact.
  constexpr float kBeyond = 2.0F * static_cast<float>(std::uint64_t{1} << (Limits::digits - 1));
  const float rounded = round_even(x);
  if (rounded >= kBeyond) return Limits::max();
  if constexpr (Limits::is_signed) {
    if (rounded < -kBeyond) return Limits::min();
  } else {
    if (rounded < 0.0F) return 0;
  }
  return static_cast<Integer>(rounded);
}

constexpr std::int64_t to_int64(float x) {
  return round_to<std::int64_t>(x);
}
constexpr std::int32_t to_int32(float x) {
  return round_to<std::int32_t>(x);
}
constexpr std::int16_t to_int16(float x) {
  return round_to<std::int16_t>(x);
}
constexpr std::uint16_t to_uint16(float x) {
  return round_to<std::uint16_t>(x);
}
constexpr std::uint8_t to_uint8(float x) {
  return round_to<std::uint8_t>(x);
}

/// Saturating. For durations only: beyond 16.7 s the product is a multiple of 2 us or more.
constexpr std::int64_t to_microseconds(float duration_s) {
  return to_int64(duration_s * 1e6F);
}

/// Ties to even; exact up to 2^24.
constexpr float to_float(std::int32_t x) {
  return static_cast<float>(x);
}
constexpr float to_float(std::uint32_t x) {
  return static_cast<float>(x);
}

/// One rounding; some cores' libraries round 64 bits twice.
constexpr float to_float(std::int64_t x) {
  const bool negative = x < 0;
  std::uint64_t size = negative ? 0 - static_cast<std::uint64_t>(x) : static_cast<std::uint64_t>(x);
  const int excess = 40 - std::countl_zero(size | 1U);  // bits beyond float's 24
  std::int32_t exponent = 0;
  if (excess > 0) {
    // 30 bits and a sticky one, for one correct rounding below.
    const int shift = excess > 6 ? excess - 6 : 0;
    const bool sticky = (size & ((std::uint64_t{1} << shift) - 1U)) != 0;
    size = (size >> shift) | (sticky ? 1U : 0U);
    exponent = shift;
  }
  const float scale = std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23);
  const float magnitude = static_cast<float>(static_cast<std::uint32_t>(size)) * scale;
  return negative ? -magnitude : magnitude;
}

/// Microseconds to seconds: two roundings.
constexpr float to_seconds(std::int64_t duration_us) {
  return to_float(duration_us) / 1e6F;
}

}  // namespace verp::math
