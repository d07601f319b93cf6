#pragma once
#include <bit>
#include <cstdint>
#include <limits>

/// Total scalar functions: no input, not even NaN, is undefined behaviour. Angles are radians. IEEE
/// float32 basic operations only: the same bits everywhere.
namespace verp::math {

inline constexpr float kPi = 0x1.921fb6p+1F;         ///< nearest float, 8.7e-8 above pi
inline constexpr float kTwoPi = 0x1.921fb6p+2F;      ///< exactly 2 kPi
inline constexpr float kHalfPi = 0x1.921fb6p+0F;     ///< exactly kPi / 2
inline constexpr float kQuarterPi = 0x1.921fb6p-1F;  ///< exactly kPi / 4
inline constexpr float kGravityMS2 = 9.80665F;       ///< standard gravity, m/s^2 (CGPM 1901)
inline constexpr float kMaxFloat = std::numeric_limits<float>::max();

static_assert(std::numeric_limits<float>::is_iec559,
              "the bit-identity contract needs IEEE float32");

/// An integer test: no compiler flag can remove it.
constexpr bool is_finite(float x) {
  return (std::bit_cast<std::uint32_t>(x) & 0x7F800000U) != 0x7F800000U;
}

/// Every foreign value enters the core through this.
constexpr float finite_or(float x, float fallback) {
  return is_finite(x) ? x : fallback;
}

constexpr float abs(float x) {
  return __builtin_fabsf(x);
}

constexpr float copysign(float magnitude, float sign) {
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(magnitude) & 0x7FFFFFFFU) |
                              (std::bit_cast<std::uint32_t>(sign) & 0x80000000U));
}

/// -1, 0 or 1; NaN gives 0.
constexpr float sign(float x) {
  return x > 0.0F ? 1.0F : (x < 0.0F ? -1.0F : 0.0F);
}

/// The second argument if either is NaN or both are equal, on every core. So min(untrusted, limit)
/// gives the limit for NaN.
constexpr float min(float a, float b) {
  return a < b ? a : b;
}
constexpr float max(float a, float b) {
  return a > b ? a : b;
}

/// NaN gives lo; so does lo > hi.
constexpr float clamp(float x, float lo, float hi) {
  if (!(x > lo)) return lo;
  return x < hi ? x : (hi > lo ? hi : lo);
}
constexpr std::int32_t clamp(std::int32_t x, std::int32_t lo, std::int32_t hi) {
  if (x <= lo) return lo;
  return x < hi ? x : (hi > lo ? hi : lo);
}

constexpr float square(float x) {
  return x * x;
}

/// Exactly a at t = 0, within one rounding of b at t = 1. t is not limited.
constexpr float lerp(float a, float b, float t) {
  return a + t * (b - a);
}

/// Correctly rounded. Negative, NaN and -0 give 0; only +infinity gives +infinity.
inline float sqrt(float x) {
  return x > 0.0F ? __builtin_sqrtf(x) : 0.0F;
}

/// Not guarded against overflow beyond 1e19.
inline float hypot(float a, float b) {
  return sqrt(a * a + b * b);
}
inline float hypot(float a, float b, float c) {
  return sqrt(a * a + (b * b + c * c));
}

/// Saturates to int32; NaN gives 0.
constexpr std::int32_t floor_to_int(float x) {
  if (x != x) return 0;
  if (x >= 2147483648.0F) return std::numeric_limits<std::int32_t>::max();
  if (x < -2147483648.0F) return std::numeric_limits<std::int32_t>::min();
  const auto truncated = static_cast<std::int32_t>(x);
  return static_cast<float>(truncated) > x ? truncated - 1 : truncated;
}

/// The same angle in (-kPi, kPi], within one rounding for |angle| <= 3 kPi. 0 from 1e7 rad on, for
/// NaN and infinities.
constexpr float wrap_angle(float angle_rad) {
  // 2 pi in three parts. The first two have 11 bits: their products with a 13-bit count are exact.
  constexpr float kHigh = 0x1.92p+2F;
  constexpr float kMiddle = 0x1.fb4p-10F;
  constexpr float kLow = 0x1.44442ep-22F;
  if (angle_rad > -kPi && angle_rad <= kPi) return angle_rad;
  if (!(abs(angle_rad) < 1e7F)) return 0.0F;
  const auto turns = static_cast<float>(floor_to_int(angle_rad * (1.0F / kTwoPi) + 0.5F));
  const float wrapped = ((angle_rad - turns * kHigh) - turns * kMiddle) - turns * kLow;
  if (wrapped > kPi) return kPi;
  return wrapped > -kPi ? wrapped : kPi;
}

}  // namespace verp::math
