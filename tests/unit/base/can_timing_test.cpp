#include "common/base/can_timing.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace verp {
namespace {

constexpr std::uint32_t kRates_hz[] = {1'000'000, 500'000, 250'000, 125'000};
constexpr std::uint32_t kMostPrescaler = 64;

TEST(CanTiming, IsExactOrSaysNo) {
  for (std::uint32_t mhz = 1; mhz <= 120; ++mhz) {
    for (const std::uint32_t rate_hz : kRates_hz) {
      const CanTiming timing = can_timing(mhz * 1'000'000, rate_hz, kMostPrescaler);
      if (!timing.possible()) continue;
      EXPECT_EQ(mhz * 1'000'000u, timing.prescaler * timing.quanta() * rate_hz) << mhz << " MHz";
      EXPECT_LE(timing.prescaler, kMostPrescaler) << mhz << " MHz";
    }
  }
}

TEST(CanTiming, SamplesLateAndFitsTheRegisters) {
  for (std::uint32_t mhz = 1; mhz <= 120; ++mhz) {
    for (const std::uint32_t rate_hz : kRates_hz) {
      const CanTiming timing = can_timing(mhz * 1'000'000, rate_hz, kMostPrescaler);
      if (!timing.possible()) continue;
      EXPECT_GE(100 * (1 + timing.before), 75 * timing.quanta()) << mhz << " MHz";
      EXPECT_LE(100 * (1 + timing.before), 90 * timing.quanta()) << mhz << " MHz";
      EXPECT_LE(timing.before, 16u) << mhz << " MHz";
      EXPECT_GE(timing.after, 2u) << mhz << " MHz";
      EXPECT_LE(timing.after, 8u) << mhz << " MHz";
      EXPECT_GE(timing.jump, 1u) << mhz << " MHz";
      EXPECT_LE(timing.jump, timing.after) << mhz << " MHz";
    }
  }
}

TEST(CanTiming, FindsWhatCommonClocksCanGive) {
  for (const std::uint32_t mhz :
       {8u, 10u, 12u, 16u, 20u, 24u, 36u, 40u, 42u, 45u, 54u, 80u, 100u}) {
    EXPECT_TRUE(can_timing(mhz * 1'000'000u, 1'000'000, kMostPrescaler).possible())
        << mhz << " MHz";
  }
  for (const std::uint32_t mhz :
       {7u, 23u, 29u}) {  // too slow; sampled too early; no division into 8 to 25
    EXPECT_FALSE(can_timing(mhz * 1'000'000u, 1'000'000, kMostPrescaler).possible())
        << mhz << " MHz";
  }
}

}  // namespace
}  // namespace verp
