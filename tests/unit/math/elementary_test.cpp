#include "common/math/elementary.hpp"

#include <gtest/gtest.h>

#include "common/math/scalar.hpp"
#include "tests/unit/math/golden_inputs.hpp"

namespace verp::math {
namespace {

using golden::from_bits;
using golden::to_bits;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kStride = 429497;  // about 10,000 of all 2^32 bit patterns
constexpr std::uint32_t kPatterns = 10000;

TEST(MathElementary, NoInputGivesNanOrInfinity) {
  for (std::uint32_t i = 0; i < kPatterns; ++i) {
    const float x = from_bits(i * kStride);
    ASSERT_TRUE(is_finite(sin(x)) && is_finite(cos(x)) && is_finite(exp(x))) << to_bits(x);
    ASSERT_TRUE(is_finite(asin(x)) && is_finite(acos(x))) << to_bits(x);
    const float y = from_bits(i * 2654435769U);
    ASSERT_TRUE(is_finite(atan2(y, x)) && is_finite(atan2(x, y))) << to_bits(x);
  }
}

TEST(MathElementary, SpecialInputsGiveTheDocumentedValues) {
  const float not_finite[] = {kInfinity, -kInfinity, kNan, -kNan, from_bits(0x7F800001U)};
  for (const float x : not_finite) {
    EXPECT_EQ(to_bits(sin(x)), 0U);
    EXPECT_EQ(cos(x), 1.0F);
    EXPECT_EQ(to_bits(sincos(x).sin), 0U);
    EXPECT_EQ(sincos(x).cos, 1.0F);
  }
  EXPECT_EQ(to_bits(asin(kNan)), 0U);
  EXPECT_EQ(to_bits(acos(kNan)), 0U);
  EXPECT_EQ(to_bits(exp(kNan)), 0U);
  EXPECT_EQ(to_bits(atan2(kNan, 1.0F)), 0U);
  EXPECT_EQ(to_bits(atan2(-1.0F, kNan)), 0U);
  EXPECT_EQ(to_bits(atan2(kNan, kInfinity)), 0U);
  EXPECT_EQ(exp(kInfinity), kMaxFloat);
  EXPECT_EQ(exp(89.0F), kMaxFloat);
  EXPECT_EQ(to_bits(exp(-kInfinity)), 0U);
  EXPECT_EQ(exp(0.0F), 1.0F);
}

TEST(MathElementary, ArcsinAndArccosLimitTheirArgument) {
  const float beyond[] = {1.0F, 1.0000001F, 2.0F, kMaxFloat, kInfinity};
  for (const float x : beyond) {
    EXPECT_EQ(asin(x), kHalfPi);
    EXPECT_EQ(asin(-x), -kHalfPi);
    EXPECT_EQ(to_bits(acos(x)), 0U);
    EXPECT_EQ(acos(-x), kPi);
  }
  EXPECT_EQ(acos(0.0F), kHalfPi);
}

TEST(MathElementary, SineIsOddAndCosineEvenBitForBit) {
  for (std::uint32_t i = 0; i < kPatterns; ++i) {
    const float x = from_bits(i * kStride & 0x7FFFFFFFU);
    if (!is_finite(x)) continue;
    ASSERT_EQ(to_bits(sin(-x)), to_bits(-sin(x))) << to_bits(x);
    ASSERT_EQ(to_bits(cos(-x)), to_bits(cos(x))) << to_bits(x);
    ASSERT_EQ(to_bits(asin(-x)), to_bits(-asin(x))) << to_bits(x);
  }
}

TEST(MathElementary, SincosIsSinAndCosBitForBit) {
  for (std::uint32_t i = 0; i < kPatterns; ++i) {
    const float x = from_bits(i * kStride);
    const SinCos both = sincos(x);
    ASSERT_EQ(to_bits(both.sin), to_bits(sin(x))) << to_bits(x);
    ASSERT_EQ(to_bits(both.cos), to_bits(cos(x))) << to_bits(x);
  }
}

TEST(MathElementary, SineAndCosineStayOnTheUnitCircle) {
  for (std::uint32_t i = 0; i < kPatterns; ++i) {
    const SinCos both = sincos(from_bits(i * kStride));
    ASSERT_LE(abs(both.sin), 1.0F);
    ASSERT_LE(abs(both.cos), 1.0F);
    ASSERT_NEAR(both.sin * both.sin + both.cos * both.cos, 1.0F, 3e-7F) << i;
  }
}

TEST(MathElementary, ArcfunctionsUndoTheFunctions) {
  for (int i = -1000; i <= 1000; ++i) {
    const float angle = static_cast<float>(i) * (kPi / 1001.0F);
    const SinCos both = sincos(angle);
    ASSERT_NEAR(atan2(both.sin, both.cos), angle, 3e-7F) << i;
    const float x = static_cast<float>(i) * 0.001F;
    ASSERT_NEAR(sin(asin(x)), x, 2e-7F) << i;
    ASSERT_NEAR(cos(acos(x)), x, 3e-7F) << i;
    ASSERT_NEAR(asin(x) + acos(x), kHalfPi, 3e-7F) << i;
  }
}

TEST(MathElementary, Atan2FollowsTheSignsOfIeee754) {
  EXPECT_EQ(to_bits(atan2(0.0F, 0.0F)), to_bits(0.0F));
  EXPECT_EQ(to_bits(atan2(-0.0F, 0.0F)), to_bits(-0.0F));
  EXPECT_EQ(atan2(0.0F, -0.0F), kPi);
  EXPECT_EQ(atan2(-0.0F, -1.0F), -kPi);
  EXPECT_EQ(atan2(1.0F, 0.0F), kHalfPi);
  EXPECT_EQ(atan2(-1.0F, -0.0F), -kHalfPi);
  EXPECT_EQ(atan2(kInfinity, kInfinity), kQuarterPi);
  EXPECT_EQ(atan2(-kInfinity, 1.0F), -kHalfPi);
  EXPECT_EQ(atan2(1.0F, -kInfinity), kPi);
  EXPECT_EQ(to_bits(atan2(-kMaxFloat, kInfinity)), to_bits(-0.0F));
}

TEST(MathElementary, Atan2NeitherOverflowsNorDependsOnScale) {
  const float scales[] = {0x1p-120F, 0x1p-60F, 1.0F, 0x1p+60F, 0x1p+126F};
  for (const float scale : scales) {
    EXPECT_EQ(to_bits(atan2(0.3F * scale, -0.7F * scale)), to_bits(atan2(0.3F, -0.7F)));
  }
  EXPECT_EQ(atan2(kMaxFloat, kMaxFloat), kQuarterPi);
  EXPECT_EQ(atan2(kMaxFloat, 0x1p-149F), kHalfPi);
}

TEST(MathElementary, ExpReachesBothEndsOfFloat) {
  EXPECT_GT(exp(88.72283F), 3.4e38F);
  EXPECT_EQ(to_bits(exp(-103.9F)), 1U);
  EXPECT_EQ(to_bits(exp(-104.0F)), 0U);
  for (int i = -1030; i < 880; ++i) {
    const float x = static_cast<float>(i) * 0.1F;
    ASSERT_LE(exp(x), exp(x + 0.05F)) << i;
  }
}

}  // namespace
}  // namespace verp::math
