#include "tests/exhaustive/functions.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "common/math/elementary.hpp"
#include "common/math/scalar.hpp"

namespace verp::exhaustive {
namespace {

bool special_sin(float x, float& expected) {
  expected = 0.0F;
  return !std::isfinite(x);
}
bool special_cos(float x, float& expected) {
  expected = 1.0F;
  return !std::isfinite(x);
}
bool special_acos(float x, float& expected) {
  expected = x <= -1.0F ? math::kPi : 0.0F;
  return !(std::fabs(x) <= 1.0F);
}
bool special_asin(float x, float& expected) {
  expected = std::isnan(x) ? 0.0F : std::copysign(math::kHalfPi, x);
  return !(std::fabs(x) <= 1.0F);
}
bool special_exp(float x, float& expected) {
  constexpr float kLargest = 0x1.62e42ep+6F;  // its exponential is a float
  expected = x > kLargest ? math::kMaxFloat : 0.0F;
  return !std::isfinite(x) || x > kLargest;
}

/// The same bits as sin() and cos().
float sin_of_both(float x) {
  return math::sincos(x).sin;
}
float cos_of_both(float x) {
  return math::sincos(x).cos;
}

std::uint64_t mix(std::uint64_t z) {  // splitmix64
  z = (z + 1) * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

float with_exponent(std::uint64_t random, int exponent) {
  const auto biased = static_cast<std::uint32_t>(std::clamp(exponent, 0, 254));
  return std::bit_cast<float>((static_cast<std::uint32_t>(random) & 0x807FFFFFU) | (biased << 23));
}

}  // namespace

const UnaryFunction kUnaryFunctions[] = {
    {"sin", 1.0, math::sin, std::sin, std::sin, special_sin},
    {"cos", 1.0, math::cos, std::cos, std::cos, special_cos},
    {"sincos.sin", 1.0, sin_of_both, std::sin, std::sin, special_sin},
    {"sincos.cos", 1.0, cos_of_both, std::cos, std::cos, special_cos},
    {"asin", 1.0, math::asin, std::asin, std::asin, special_asin},
    {"acos", 1.0, math::acos, std::acos, std::acos, special_acos},
    {"exp", 1.0, math::exp, std::exp, std::exp, special_exp},
};
const int kUnaryFunctionCount = sizeof kUnaryFunctions / sizeof kUnaryFunctions[0];

Pair stratified_pair(std::uint64_t i) {
  const std::uint64_t a = mix(2 * i);
  const std::uint64_t b = mix(2 * i + 1);
  const auto any_exponent = static_cast<int>((a >> 32) % 255);
  const auto other = b >> 32;
  switch (i & 3U) {
    case 0:
      return {with_exponent(a, any_exponent), with_exponent(b, static_cast<int>(other % 255))};
    case 1:
      return {with_exponent(a, any_exponent),
              with_exponent(b, any_exponent + static_cast<int>(other % 5) - 2)};
    case 2:
      return {with_exponent(a, any_exponent),
              with_exponent(b, any_exponent + static_cast<int>(other % 61) - 30)};
    default:
      return {with_exponent(a, 107 + any_exponent % 24),
              with_exponent(b, 107 + static_cast<int>(other % 24))};
  }
}

double error_ulp(float result, double exact) {
  if (!std::isfinite(result)) return std::numeric_limits<double>::infinity();
  const auto biased = static_cast<int>((std::bit_cast<std::uint64_t>(exact) >> 52) & 0x7FFU);
  const int exponent = std::max(biased - 1023, -126);
  const double per_ulp =
      std::bit_cast<double>(static_cast<std::uint64_t>(23 - exponent + 1023) << 52);
  return std::fabs(static_cast<double>(result) - exact) * per_ulp;
}

double fine_error_ulp(float result, long double exact) {
  if (!std::isfinite(result)) return std::numeric_limits<double>::infinity();
  const int exponent = exact == 0.0L ? -126 : std::max(std::ilogb(exact), -126);
  const long double error = std::fabs(static_cast<long double>(result) - exact);
  return static_cast<double>(std::ldexp(error, 23 - exponent));
}

}  // namespace verp::exhaustive
