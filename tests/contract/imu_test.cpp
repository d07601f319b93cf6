#include <gtest/gtest.h>

#include <cstdint>

#include "hal/contract/imu.hpp"
#include "tests/contract/backends.hpp"

// hal/contract/imu.hpp.
namespace verp {
namespace {

template <class Backend>
class ImuContract : public ::testing::Test {
 protected:
  Backend chip;
  hal::ImuSample sample;
};
TYPED_TEST_SUITE(ImuContract, test::Imus);

TYPED_TEST(ImuContract, HasNothingBeforeTheFirstSample) {
  this->sample.time_us = 7;
  EXPECT_EQ(this->chip.read(this->sample), hal::ImuStatus::kStale);
  EXPECT_EQ(this->sample.time_us, 7u) << "only kFresh changes the sample";
}

TYPED_TEST(ImuContract, GivesTheMeanOfAllSamplesSinceTheLastReadAndEachOnce) {
  std::uint64_t last_us = 0;
  for (std::int16_t i = 1; i < 20; ++i) {
    this->chip.measure(static_cast<std::int16_t>(-i));
    this->chip.measure(static_cast<std::int16_t>(3 * i));
    ASSERT_EQ(this->chip.read(this->sample), hal::ImuStatus::kFresh);
    EXPECT_EQ(this->sample.gyro_count[0], i);
    EXPECT_GT(this->sample.time_us, last_us);
    last_us = this->sample.time_us;
    EXPECT_EQ(this->chip.read(this->sample), hal::ImuStatus::kStale);
  }
  EXPECT_EQ(this->chip.faults(), 0u);
}

TYPED_TEST(ImuContract, RoundsToTheNearestOnBothSidesAlikeAndKeepsToTheLimits) {
  const struct {
    std::int16_t samples[3], mean;
  } cases[] = {{{0, 0, 1}, 0},
               {{0, 1, 1}, 1},
               {{0, 0, -1}, 0},
               {{0, -1, -1}, -1},
               {{32767, 32767, 32767}, 32767},
               {{-32768, -32768, -32768}, -32768}};
  for (const auto& each : cases) {
    for (const std::int16_t gyro_x : each.samples) this->chip.measure(gyro_x);
    ASSERT_EQ(this->chip.read(this->sample), hal::ImuStatus::kFresh);
    EXPECT_EQ(this->sample.gyro_count[0], each.mean);
  }
}

TYPED_TEST(ImuContract, CountsFaultsKeepsTheSampleAndComesBack) {
  this->chip.measure(1);
  ASSERT_EQ(this->chip.read(this->sample), hal::ImuStatus::kFresh);
  const std::uint64_t before_us = this->sample.time_us;
  this->chip.break_chip(true);
  for (std::uint32_t i = 1; i <= 50; ++i) {
    EXPECT_EQ(this->chip.read(this->sample), hal::ImuStatus::kFault);
    EXPECT_EQ(this->chip.faults(), i);
  }
  EXPECT_EQ(this->sample.time_us, before_us);
  this->chip.break_chip(false);
  this->chip.settle();
  this->chip.measure(2);
  ASSERT_EQ(this->chip.read(this->sample), hal::ImuStatus::kFresh);
  EXPECT_EQ(this->sample.gyro_count[0], 2);
  EXPECT_EQ(this->chip.faults(), 50u);
}

TEST(ScriptedImu, RefusesASampleThatIsNotNewer) {
  hal::ScriptedImu imu;
  EXPECT_TRUE(imu.measure({{1, 2, 3}, {4, 5, 6}, 100}));
  EXPECT_FALSE(imu.measure({{}, {}, 100}));
}

}  // namespace
}  // namespace verp
