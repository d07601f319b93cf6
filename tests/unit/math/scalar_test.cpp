#include "common/math/scalar.hpp"

#include <gtest/gtest.h>

namespace verp::math {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kDenormal = 0x1p-149F;

std::uint32_t to_bits(float x) {
  return std::bit_cast<std::uint32_t>(x);
}

TEST(MathScalar, IsFiniteKnowsEverySpecial) {
  const float finite[] = {0.0F, -0.0F, kDenormal, kMaxFloat, -kMaxFloat};
  for (const float x : finite) EXPECT_TRUE(is_finite(x));
  const float special[] = {kInfinity, -kInfinity, kNan, -kNan};
  for (const float x : special) {
    EXPECT_FALSE(is_finite(x));
    EXPECT_EQ(finite_or(x, 3.0F), 3.0F);
  }
}

TEST(MathScalar, ClampIsTotal) {
  EXPECT_EQ(clamp(0.5F, 0.0F, 1.0F), 0.5F);
  EXPECT_EQ(clamp(-2.0F, 0.0F, 1.0F), 0.0F);
  EXPECT_EQ(clamp(kInfinity, 0.0F, 1.0F), 1.0F);
  EXPECT_EQ(clamp(kNan, -1.0F, 1.0F), -1.0F);
  EXPECT_EQ(clamp(0.5F, 1.0F, 0.0F), 1.0F);
  EXPECT_EQ(clamp(7.0F, 1.0F, 0.0F), 1.0F);
  EXPECT_EQ(clamp(std::int32_t{7}, std::int32_t{-3}, std::int32_t{3}), 3);
  EXPECT_EQ(clamp(std::int32_t{-7}, std::int32_t{-3}, std::int32_t{3}), -3);
}

TEST(MathScalar, SqrtIsExactOnSquaresAndNeverNan) {
  for (int i = 0; i <= 4096; ++i) {
    const auto root = static_cast<float>(i);
    ASSERT_EQ(sqrt(root * root), root);
  }
  EXPECT_EQ(to_bits(sqrt(2.0F)), 0x3FB504F3U);
  EXPECT_EQ(to_bits(sqrt(kDenormal)), 0x1A3504F3U);
  const float to_zero[] = {-1.0F, -kDenormal, -0.0F, kNan, -kInfinity};
  for (const float x : to_zero) EXPECT_EQ(to_bits(sqrt(x)), 0U);
}

TEST(MathScalar, FloorToIntSaturates) {
  EXPECT_EQ(floor_to_int(-0.5F), -1);
  EXPECT_EQ(floor_to_int(-1.0F), -1);
  EXPECT_EQ(floor_to_int(1.99F), 1);
  EXPECT_EQ(floor_to_int(-kDenormal), -1);
  EXPECT_EQ(floor_to_int(2147483520.0F), 2147483520);
  EXPECT_EQ(floor_to_int(3e9F), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(floor_to_int(-kInfinity), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(floor_to_int(kNan), 0);
}

TEST(MathScalar, WrapAngleKeepsAnglesThatNeedNoWrapping) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_EQ(to_bits(wrap_angle(-0.0F)), 0x80000000U);
  EXPECT_EQ(wrap_angle(-3.0F), -3.0F);
}

TEST(MathScalar, WrapAngleStaysInRangeForAnyInput) {
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const float x = std::bit_cast<float>(i * 214748U);
    const float wrapped = wrap_angle(x);
    ASSERT_TRUE(wrapped > -kPi && wrapped <= kPi) << i;
  }
  EXPECT_EQ(wrap_angle(kNan), 0.0F);
  EXPECT_EQ(wrap_angle(kInfinity), 0.0F);
}

TEST(MathScalar, WrapAngleTakesWholeTurnsOff) {
  for (int turns = -100; turns <= 100; ++turns) {
    const float angle = 0.7F + static_cast<float>(turns) * kTwoPi;
    ASSERT_NEAR(wrap_angle(angle), 0.7F, 6e-5F) << turns;
  }
  EXPECT_NEAR(wrap_angle(3.5F), -2.7831853F, 2e-7F);
  EXPECT_NEAR(wrap_angle(-6.5F), -0.21681469F, 2e-7F);
}

TEST(MathScalar, LerpAndSignsBehaveAtTheirEnds) {
  EXPECT_EQ(lerp(2.0F, 5.0F, 0.0F), 2.0F);
  EXPECT_EQ(lerp(2.0F, 5.0F, 1.0F), 5.0F);
  EXPECT_EQ(sign(kNan), 0.0F);
  EXPECT_EQ(sign(-3.0F), -1.0F);
  EXPECT_EQ(copysign(3.0F, -0.0F), -3.0F);
  EXPECT_EQ(min(kNan, 1.0F), 1.0F);
  EXPECT_EQ(max(kNan, 1.0F), 1.0F);
}

}  // namespace
}  // namespace verp::math
