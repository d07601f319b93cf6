#include "common/math/elementary.hpp"

#include <bit>
#include <cstdint>

#include "common/math/scalar.hpp"

namespace verp::math {
namespace {

constexpr std::uint32_t kInfinityBits = 0x7F800000U;
constexpr float kRoundingShift = 12582912.0F;  // 1.5 * 2^23: adding it rounds to an integer

constexpr std::uint32_t bits_of(float x) {
  return std::bit_cast<std::uint32_t>(x);
}
constexpr std::uint32_t magnitude_bits(float x) {
  return bits_of(x) & 0x7FFFFFFFU;
}

constexpr float power_of_two(int exponent) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

/// angle = quadrant * pi/2 + (high + low). |high| is hardly above pi/4, |low| about an ulp of high.
struct Reduced {
  float high;
  float low;
  std::uint32_t quadrant;  // only the two lowest bits count
};

/// For |angle| < 64: Cody-Waite in three parts. The first two have 18 bits, so products with a
/// count of at most 41 are exact.
inline Reduced reduce(float angle_rad) {
  constexpr float kHigh = 0x1.921f8p+0F;
  constexpr float kMiddle = 0x1.aa22p-19F;
  constexpr float kLow = 0x1.68c234p-39F;
  const float shifted = angle_rad * 0x1.45f306p-1F + kRoundingShift;  // 2 / pi
  const float count = shifted - kRoundingShift;
  const float exact = angle_rad - count * kHigh;
  const float middle = count * kMiddle;
  const float high = exact - middle;
  return {high, ((exact - high) - middle) - count * kLow, bits_of(shifted)};
}

/// For other finite angles: Payne-Hanek with integers.
Reduced reduce_large(float angle_rad) {
  // 2 / pi = 0.A2F9836E..., after one word of zeros for angles below 2^25.
  constexpr std::uint32_t kTwoOverPi[] = {0x00000000U, 0xA2F9836EU, 0x4E441529U, 0xFC2757D1U,
                                          0xF534DDC0U, 0xDB629599U, 0x3C439041U, 0xFE5163ABU};
  // |angle| = mantissa * 2^exponent. Multiples of 4 quadrants drop out: start at the bit of 2
  // quadrants, keep 96 bits.
  const std::uint32_t bits = magnitude_bits(angle_rad);
  const std::uint32_t mantissa = (bits & 0x007FFFFFU) | 0x00800000U;
  const std::uint32_t first_bit = (bits >> 23) - 150U - 2U + 32U;
  const std::uint32_t* word = kTwoOverPi + (first_bit >> 5);
  const std::uint32_t shift = first_bit & 31U;
  const auto window = [&](int i) {
    const std::uint64_t pair = (std::uint64_t{word[i]} << 32) | word[i + 1];
    return static_cast<std::uint32_t>((pair << shift) >> 32);
  };
  const std::uint64_t product = (std::uint64_t{mantissa * window(0)} << 32) +
                                std::uint64_t{mantissa} * window(1) +
                                ((std::uint64_t{mantissa} * window(2)) >> 32);
  const std::uint64_t quadrant = (product + (std::uint64_t{1} << 61)) >> 62;
  const std::uint64_t rest = product - (quadrant << 62);  // two's complement, in 2^-62 quadrants
  const bool below = (rest >> 63) != 0;
  const std::uint64_t size = (below ? 0 - rest : rest) | 1U;  // never 0: 2 / pi is irrational
  const int zeros = std::countl_zero(size);
  const std::uint64_t radians = ((size << zeros) >> 32) * 0xC90FDAA2U;  // pi/2 * 2^31
  const bool negative = angle_rad < 0.0F;
  const float scale = power_of_two(-21 - zeros) * (below != negative ? -1.0F : 1.0F);
  const float head = scale * static_cast<float>(static_cast<std::uint32_t>(radians >> 40));
  const float tail = (scale * 0x1p-24F) *
                     static_cast<float>(static_cast<std::uint32_t>(radians >> 16) & 0xFFFFFFU);
  const float high = head + tail;
  const auto turned = static_cast<std::uint32_t>(quadrant);
  return {high, (head - high) + tail, negative ? 0U - turned : turned};
}

/// sin(high + low); minimax, 2^-27.9 relative.
inline float sin_kernel(float high, float low) {
  const float z = high * high;
  const float p = -0x1.555546p-3F + z * (0x1.110776p-7F + z * -0x1.9952fap-13F);
  return high + (low + (high * z) * p);
}

/// cos(high + low); minimax, 2^-33 relative. 1 - z/2 keeps its rounding error.
inline float cos_kernel(float high, float low) {
  const float z = high * high;
  const float half = 0.5F * z;
  const float head = 1.0F - half;
  const float p = 0x1.55554ap-5F + z * (-0x1.6c0c28p-10F + z * 0x1.99e80cp-16F);
  return head + (((1.0F - head) - half) + ((z * z) * p - high * low));
}

/// asin(s) = s + s * asin_tail(s * s) for s in [0, 1/2]; minimax, 2^-27.6 relative.
inline float asin_tail(float z) {
  return z *
         (0x1.5555c8p-3F +
          z * (0x1.330204p-4F + z * (0x1.747bbap-5F + z * (0x1.8c3e2ap-6F + z * 0x1.595c8cp-5F))));
}

/// sqrt(z) = high + low, z > 0. high has 12 bits: its square is exact.
struct SplitRoot {
  float root;
  float high;
  float low;
};
inline SplitRoot split_sqrt(float z) {
  const float root = __builtin_sqrtf(z);
  const float high = std::bit_cast<float>(bits_of(root) & 0xFFFFF000U);
  return {root, high, (z - high * high) / (root + high)};
}

constexpr float kHalfPiLow = -0x1.777a5cp-25F;  // pi/2 - kHalfPi
constexpr float kPiLow = -0x1.777a5cp-24F;
constexpr std::uint32_t kSmallBits = 0x39800000U;       // 2^-12
constexpr std::uint32_t kLargeAngleBits = 0x42800000U;  // 64

}  // namespace

SinCos sincos(float angle_rad) {
  const std::uint32_t size = magnitude_bits(angle_rad);
  if (size < kSmallBits) return {angle_rad, 1.0F};
  if (size >= kInfinityBits) return {0.0F, 1.0F};
  const Reduced r = size < kLargeAngleBits ? reduce(angle_rad) : reduce_large(angle_rad);
  const float s = sin_kernel(r.high, r.low);
  const float c = cos_kernel(r.high, r.low);
  const float sine = (r.quadrant & 1U) != 0 ? c : s;
  const float cosine = (r.quadrant & 1U) != 0 ? s : c;
  return {(r.quadrant & 2U) != 0 ? -sine : sine, ((r.quadrant + 1U) & 2U) != 0 ? -cosine : cosine};
}

float sin(float angle_rad) {
  const std::uint32_t size = magnitude_bits(angle_rad);
  if (size < kSmallBits) return angle_rad;
  if (size >= kInfinityBits) return 0.0F;
  const Reduced r = size < kLargeAngleBits ? reduce(angle_rad) : reduce_large(angle_rad);
  const float sine = (r.quadrant & 1U) != 0 ? cos_kernel(r.high, r.low) : sin_kernel(r.high, r.low);
  return (r.quadrant & 2U) != 0 ? -sine : sine;
}

float cos(float angle_rad) {
  const std::uint32_t size = magnitude_bits(angle_rad);
  if (size < kSmallBits || size >= kInfinityBits) return 1.0F;
  const Reduced r = size < kLargeAngleBits ? reduce(angle_rad) : reduce_large(angle_rad);
  const float cosine =
      (r.quadrant & 1U) != 0 ? sin_kernel(r.high, r.low) : cos_kernel(r.high, r.low);
  return ((r.quadrant + 1U) & 2U) != 0 ? -cosine : cosine;
}

float atan2(float y, float x) {
  const std::uint32_t x_bits = magnitude_bits(x);
  const std::uint32_t y_bits = magnitude_bits(y);
  const bool steep = y_bits > x_bits;
  const std::uint32_t larger = steep ? y_bits : x_bits;
  const std::uint32_t smaller = steep ? x_bits : y_bits;
  float ratio = 0.0F;
  if (larger - 1U < kInfinityBits - 1U) {
    ratio = std::bit_cast<float>(smaller) / std::bit_cast<float>(larger);
  } else if (larger > kInfinityBits) {
    return 0.0F;  // a NaN
  } else if (smaller == kInfinityBits) {
    ratio = 1.0F;
  }
  // Minimax on [0, 1], 2^-27.9 relative; the last bits make atan2(1, 1) kQuarterPi.
  const float z = ratio * ratio;
  float p = 0x1.66df3cp-7F + z * -0x1.d97be6p-10F;
  p = -0x1.ff675ep-6F + z * p;
  p = 0x1.dad4dep-5F + z * p;
  p = -0x1.5827fep-4F + z * p;
  p = 0x1.c091aep-4F + z * p;
  p = -0x1.2420b0p-3F + z * p;
  p = 0x1.9991e2p-3F + z * p;
  p = -0x1.55553ep-2F + z * p;
  float angle = ratio + (ratio * z) * p;
  const bool backward = (bits_of(x) >> 31) != 0;
  if (steep) {
    angle = kHalfPi + ((backward ? angle : -angle) + kHalfPiLow);
  } else if (backward) {
    angle = kPi + (kPiLow - angle);
  }
  return copysign(angle, y);
}

float asin(float x) {
  const float size = abs(x);
  if (size < 0.5F) {
    return size < 0x1p-12F ? x : x + x * asin_tail(x * x);
  }
  if (x != x) return 0.0F;
  if (size >= 1.0F) return copysign(kHalfPi, x);
  // asin(x) = pi/2 - 2 asin(sqrt((1 - x) / 2)), root and pi/2 in two parts.
  const float z = 0.5F * (1.0F - size);
  const SplitRoot s = split_sqrt(z);
  const float tail = 2.0F * (s.root * asin_tail(z) + s.low) - kHalfPiLow;
  const float angle = kQuarterPi - (tail - (kQuarterPi - 2.0F * s.high));
  return copysign(angle, x);
}

float acos(float x) {
  const float size = abs(x);
  if (size < 0.5F) return kHalfPi - (x + (x * asin_tail(x * x) - kHalfPiLow));
  if (size >= 1.0F) return x < 0.0F ? kPi : 0.0F;
  if (x != x) return 0.0F;
  const float z = 0.5F * (1.0F - size);
  const SplitRoot s = split_sqrt(z);
  const float tail = s.root * asin_tail(z) + s.low;
  if (x > 0.0F) return 2.0F * (s.high + tail);
  return kPi - 2.0F * (s.high + (tail - kHalfPiLow));
}

float exp(float x) {
  if (!(x > -104.0F)) return 0.0F;  // below half the smallest subnormal; also NaN
  if (x > 88.8F) return kMaxFloat;
  const float shifted = x * 0x1.715476p+0F + kRoundingShift;  // 1 / ln 2
  const float count = shifted - kRoundingShift;
  const float exact = x - count * 0x1.62e4p-1F;  // ln 2 in two parts: this product is exact
  const float rest = count * 0x1.7f7d1cp-20F;
  const float high = exact - rest;
  const float low = (exact - high) - rest;
  // Minimax for (e^r - 1 - r) / r^2 on |r| <= ln(2) / 2, 2^-27.8 relative.
  float p = 0x1.123a74p-7F + high * 0x1.6a24f4p-10F;
  p = 0x1.5558f4p-5F + high * p;
  p = 0x1.555490p-3F + high * p;
  p = 0x1.fffffcp-2F + high * p;
  const float fraction = 1.0F + (high + (low + (high * high) * p));
  const auto exponent = static_cast<std::int32_t>(bits_of(shifted) - bits_of(kRoundingShift));
  // Two factors, because 2^128 and 2^-150 are not normal floats. Only the second product can round.
  const int half = exponent >> 1;
  const float result = (fraction * power_of_two(half)) * power_of_two(exponent - half);
  return result <= kMaxFloat ? result : kMaxFloat;
}

}  // namespace verp::math
