#include "common/math/convert.hpp"

#include <gtest/gtest.h>

namespace verp::math {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(MathConvert, RoundsToNearestTiesToEven) {
  EXPECT_EQ(to_int32(0.5F), 0);
  EXPECT_EQ(to_int32(1.5F), 2);
  EXPECT_EQ(to_int32(-2.5F), -2);
  EXPECT_EQ(to_int32(0.49999997F), 0);
  EXPECT_EQ(to_int32(-0.50000006F), -1);
  EXPECT_EQ(to_int32(4194303.5F), 4194304);  // where the fast path ends
  EXPECT_EQ(to_int32(-4194302.5F), -4194302);
  EXPECT_EQ(to_int32(4194304.5F), 4194304);
  EXPECT_EQ(to_int32(8388607.5F), 8388608);
  EXPECT_EQ(to_int32(16777215.0F), 16777215);
  EXPECT_EQ(round_even(kNan), 0.0F);
}

template <class Integer>
void expect_saturation() {
  using Limits = std::numeric_limits<Integer>;
  EXPECT_EQ(round_to<Integer>(kNan), Integer{0});
  EXPECT_EQ(round_to<Integer>(kInfinity), Limits::max());
  EXPECT_EQ(round_to<Integer>(-kInfinity), Limits::min());
  EXPECT_EQ(round_to<Integer>(kMaxFloat), Limits::max());
  EXPECT_EQ(round_to<Integer>(-kMaxFloat), Limits::min());
  const float beyond = 2.0F * static_cast<float>(Limits::max() / 2 + 1);
  EXPECT_EQ(round_to<Integer>(beyond), Limits::max());
  EXPECT_EQ(round_to<Integer>(Limits::is_signed ? -beyond : -0.4F), Limits::min());
  const float inside = std::bit_cast<float>(std::bit_cast<std::uint32_t>(beyond) - 1U);
  if (sizeof(Integer) >= 4) {
    EXPECT_EQ(static_cast<float>(round_to<Integer>(inside)), inside);
  }
}

TEST(MathConvert, EveryIntegerTypeSaturatesAndNanIsZero) {
  expect_saturation<std::int8_t>();
  expect_saturation<std::int16_t>();
  expect_saturation<std::int32_t>();
  expect_saturation<std::int64_t>();
  expect_saturation<std::uint8_t>();
  expect_saturation<std::uint16_t>();
  expect_saturation<std::uint32_t>();
  expect_saturation<std::uint64_t>();
}

TEST(MathConvert, SmallTypesKeepTheirEnds) {
  EXPECT_EQ(to_int16(32767.4F), 32767);
  EXPECT_EQ(to_int16(32767.5F), 32767);
  EXPECT_EQ(to_int16(-32768.5F), -32768);
  EXPECT_EQ(to_uint16(65535.49F), 65535);
  EXPECT_EQ(to_uint16(65536.0F), 65535);
  EXPECT_EQ(to_uint16(-1.0F), 0);
  EXPECT_EQ(to_uint16(-0.3F), 0);
  EXPECT_EQ(to_uint8(255.5F), 255);
}

TEST(MathConvert, ConversionsAreMonotonic) {
  std::int16_t last16 = std::numeric_limits<std::int16_t>::min();
  std::int32_t last32 = std::numeric_limits<std::int32_t>::min();
  std::int64_t last64 = std::numeric_limits<std::int64_t>::min();
  for (int i = -5000; i <= 5000; ++i) {
    const auto size = static_cast<std::uint32_t>(i < 0 ? -i : i) * 427819U;
    const float x = std::bit_cast<float>(i < 0 ? size | 0x80000000U : size);
    ASSERT_TRUE(to_int16(x) >= last16 && to_int32(x) >= last32 && to_int64(x) >= last64) << i;
    last16 = to_int16(x);
    last32 = to_int32(x);
    last64 = to_int64(x);
  }
}

TEST(MathConvert, MicrosecondsRoundTripForDurationsOfTheGait) {
  EXPECT_EQ(to_microseconds(0.030F), 30000);
  EXPECT_EQ(to_microseconds(0.450F), 450000);
  EXPECT_EQ(to_microseconds(-1e30F), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(to_microseconds(kNan), 0);
  for (std::int64_t us = 0; us < 4000000; us += 997) {
    ASSERT_EQ(to_microseconds(to_seconds(us)), us);
  }
}

TEST(MathConvert, Int64ToFloatRoundsOnceToNearestEven) {
  EXPECT_EQ(to_float(std::int64_t{0}), 0.0F);
  EXPECT_EQ(to_float(std::int64_t{-1}), -1.0F);
  EXPECT_EQ(to_float(std::int64_t{16777217}), 16777216.0F);
  EXPECT_EQ(to_float(std::int64_t{16777219}), 16777220.0F);
  EXPECT_EQ(to_float(std::numeric_limits<std::int64_t>::max()), 0x1p+63F);
  EXPECT_EQ(to_float(std::numeric_limits<std::int64_t>::min()), -0x1p+63F);
  // Just above a tie: double rounding would go wrong.
  EXPECT_EQ(to_float((std::int64_t{1} << 60) + (std::int64_t{1} << 36) + 1), 0x1.000002p+60F);
  EXPECT_EQ(to_float((std::int64_t{1} << 60) + (std::int64_t{1} << 36)), 0x1p+60F);
}

}  // namespace
}  // namespace verp::math
