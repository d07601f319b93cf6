#pragma once
#include <bit>
#include <cstdint>

#include "common/math/elementary.hpp"

/// Shared by the test and by `verp_exhaustive --golden`.
namespace verp::math::golden {

inline float from_bits(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}
inline std::uint32_t to_bits(float x) {
  return std::bit_cast<std::uint32_t>(x);
}

inline float sin_of_both(float x) {
  return sincos(x).sin;
}
inline float cos_of_both(float x) {
  return sincos(x).cos;
}

struct Function {
  const char* name;
  float (*call)(float);
};
inline constexpr Function kFunctions[] = {{"sin", sin},
                                          {"cos", cos},
                                          {"asin", asin},
                                          {"acos", acos},
                                          {"exp", exp},
                                          {"sincos.sin", sin_of_both},
                                          {"sincos.cos", cos_of_both}};
inline constexpr int kFunctionCount = sizeof kFunctions / sizeof kFunctions[0];

inline constexpr float kArguments[] = {0.0F,
                                       -0.0F,
                                       0x1p-149F,
                                       -0x1p-149F,
                                       0x1.fffffep-13F,
                                       0x1p-12F,
                                       0.1F,
                                       -0.3F,
                                       0.49999997F,
                                       0.5F,
                                       -0.5F,
                                       0.5000001F,
                                       0.70710678F,
                                       -0.86602540F,
                                       0.99999994F,
                                       -0.99999994F,
                                       1.0F,
                                       -1.0F,
                                       0.78539816F,
                                       0.78539824F,
                                       1.5707963F,
                                       1.5707964F,
                                       -2.0F,
                                       3.1415925F,
                                       3.1415927F,
                                       4.7123890F,
                                       -6.2831855F,
                                       22.0F,
                                       -63.999996F,
                                       64.0F,
                                       0x1.921fb6p+9F,
                                       8192.0F,
                                       0x1.6adf56p+56F,
                                       -0x1.517a74p+95F,
                                       88.722839F,
                                       88.72284F,
                                       -87.336548F,
                                       -103.97208F,
                                       -104.0F,
                                       0x1.fffffep+127F,
                                       -0x1.fffffep+127F};
inline constexpr int kArgumentCount = sizeof kArguments / sizeof kArguments[0];

struct Point {
  float y;
  float x;
};
inline constexpr Point kPoints[] = {{0.0F, 0.0F},
                                    {-0.0F, 0.0F},
                                    {0.0F, -0.0F},
                                    {-0.0F, -0.0F},
                                    {0.0F, 1.0F},
                                    {0.0F, -1.0F},
                                    {-0.0F, -1.0F},
                                    {1.0F, 0.0F},
                                    {-1.0F, 0.0F},
                                    {1.0F, 1.0F},
                                    {1.0F, -1.0F},
                                    {-1.0F, -1.0F},
                                    {0.3F, 0.4F},
                                    {-0.04F, 0.45F},
                                    {0x1p-149F, 0x1p-149F},
                                    {0x1p-149F, -0x1p+127F},
                                    {0x1p+127F, 0x1p-149F},
                                    {0x1p-126F, 0x1p-3F},
                                    {0x1.fffffep+127F, 0x1.fffffep+127F},
                                    {0x1.fffffep+127F, -0x1p+126F},
                                    {0x1.ce0b24p-53F, 0x1.cc1ec6p-50F}};
inline constexpr int kPointCount = sizeof kPoints / sizeof kPoints[0];

inline constexpr std::uint64_t kHashStart = 0xCBF29CE484222325U;
inline constexpr std::uint64_t hash_word(std::uint64_t hash, std::uint32_t word) {
  return (hash ^ word) * 0x100000001B3U;  // FNV-1a, word-wise
}

/// An odd stride reaches every exponent.
inline std::uint64_t hash_of(float (*call)(float), std::uint32_t count) {
  std::uint64_t hash = kHashStart;
  for (std::uint32_t i = 0; i < count; ++i) {
    hash = hash_word(hash, to_bits(call(from_bits(i * 2654435769U))));
  }
  return hash;
}

/// For arguments within +-bound.
inline std::uint64_t hash_within(float (*call)(float), float bound, std::uint32_t count) {
  std::uint64_t hash = kHashStart;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto random = static_cast<std::int32_t>(i * 2654435769U);
    hash = hash_word(hash, to_bits(call(static_cast<float>(random) * 0x1p-31F * bound)));
  }
  return hash;
}

inline std::uint64_t hash_of_atan2(std::uint32_t count) {
  std::uint64_t hash = kHashStart;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float y = from_bits(i * 2654435769U);
    const float x = from_bits(i * 2246822519U + 3266489917U);
    hash = hash_word(hash, to_bits(atan2(y, x)));
    // Close exponents, where the quotient matters.
    const std::uint32_t close = 0x3F000000U + ((i & 3U) << 23);
    const float near_y = from_bits((to_bits(y) & 0x807FFFFFU) | 0x3F000000U);
    hash = hash_word(hash, to_bits(atan2(near_y, from_bits((to_bits(x) & 0x807FFFFFU) | close))));
  }
  return hash;
}

inline constexpr std::uint32_t kHashCount = 20000;
inline constexpr float kHashBound[] = {64.0F, 64.0F, 1.0F, 1.0F, 104.0F, 64.0F, 64.0F};

}  // namespace verp::math::golden
