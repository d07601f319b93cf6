#include <gtest/gtest.h>

#include <cstdint>

#include "hal/contract/range_finder.hpp"
#include "tests/contract/backends.hpp"

// hal/contract/range_finder.hpp.
namespace verp {
namespace {

template <class Backend>
class RangeFinderContract : public ::testing::Test {
 protected:
  Backend laser;
  hal::RangeScan scan;
};
TYPED_TEST_SUITE(RangeFinderContract, test::RangeFinders);

TYPED_TEST(RangeFinderContract, HasNothingBeforeTheFirstScan) {
  this->scan.time_us = 7;
  EXPECT_EQ(this->laser.read(this->scan), hal::RangeStatus::kStale);
  EXPECT_EQ(this->scan.time_us, 7u) << "only kFresh changes the scan";
}

TYPED_TEST(RangeFinderContract, GivesEachScanOnceAndTheNewestOnly) {
  this->laser.read(this->scan);
  std::uint64_t last_us = 0;
  for (int i = 1; i < 10; ++i) {
    this->laser.turn();
    this->laser.turn();
    ASSERT_EQ(this->laser.read(this->scan), hal::RangeStatus::kFresh);
    EXPECT_EQ(this->scan.steps, TypeParam::kSteps);
    // 1 m ahead, nothing on the left.
    EXPECT_NEAR(this->scan.range_mm[TypeParam::kSteps / 2], 1000,
                80);  // a twin stands slightly off
    EXPECT_EQ(this->scan.range_mm[TypeParam::kSteps - 1], 0);
    EXPECT_GT(this->scan.time_us, last_us);
    last_us = this->scan.time_us;
    EXPECT_EQ(this->laser.read(this->scan), hal::RangeStatus::kStale);
  }
  EXPECT_EQ(this->laser.faults(), 0u);
}

TYPED_TEST(RangeFinderContract, CountsFaultsKeepsTheScanAndComesBack) {
  if constexpr (TypeParam::kBreaks) {
    this->laser.read(this->scan);
    this->laser.turn();
    ASSERT_EQ(this->laser.read(this->scan), hal::RangeStatus::kFresh);
    const std::uint64_t before_us = this->scan.time_us;
    this->laser.break_it(true);
    for (std::uint32_t i = 1; i <= 3; ++i) {
      this->laser.wait();
      EXPECT_EQ(this->laser.read(this->scan), hal::RangeStatus::kFault);
      EXPECT_EQ(this->laser.faults(), i);
    }
    EXPECT_EQ(this->scan.time_us, before_us);
    this->laser.break_it(false);
    this->laser.wait();
    this->laser.read(this->scan);  // asks again
    const std::uint32_t faults = this->laser.faults();
    this->laser.turn();
    ASSERT_EQ(this->laser.read(this->scan), hal::RangeStatus::kFresh);
    EXPECT_EQ(this->laser.faults(), faults);
  } else {
    EXPECT_EQ(this->laser.faults(), 0u);  // a twin's never fails
  }
}

}  // namespace
}  // namespace verp
