#include <gtest/gtest.h>

#include <cstdint>

#include "hal/contract/tick_source.hpp"
#include "hal/contract/watchdog.hpp"
#include "tests/contract/backends.hpp"

// hal/contract/tick_source.hpp and watchdog.hpp.

namespace verp {
namespace {

template <class Backend>
class TickSourceContract : public ::testing::Test {
 protected:
  Backend backend;
};
TYPED_TEST_SUITE(TickSourceContract, test::TickSources);

TYPED_TEST(TickSourceContract, MakesNoTickBeforeItIsStarted) {
  EXPECT_EQ(this->backend.source.wait(), 0u);
  EXPECT_FALSE(this->backend.source.start(0));
  EXPECT_EQ(this->backend.source.wait(), 0u);
}

TYPED_TEST(TickSourceContract, NeverReturnsEarlyAndNeverDrifts) {
  auto& source = this->backend.source;
  const std::uint64_t begin_us = source.now_us();
  ASSERT_TRUE(source.start(2000));
  std::uint64_t tick = 0;
  for (int i = 0; i < 50; ++i) {
    const std::uint32_t begun = source.wait();
    EXPECT_GE(begun, 1u);
    tick += begun;
    EXPECT_GE(source.now_us(), begin_us + tick * 2000);
  }
}

TYPED_TEST(TickSourceContract, CountsWhatTheLoopMissed) {
  auto& source = this->backend.source;
  ASSERT_TRUE(source.start(5000));
  EXPECT_GE(source.wait(), 1u);
  const std::uint64_t before_us = source.now_us();
  this->backend.spend(17'000);
  const std::uint32_t begun = source.wait();
  EXPECT_GE(begun, 3u);
  EXPECT_LE(std::uint64_t{begun - 1} * 5000, source.now_us() - before_us);
  EXPECT_GE(source.wait(), 1u);
}

TYPED_TEST(TickSourceContract, BeginsAnewWhenStartedAgain) {
  auto& source = this->backend.source;
  ASSERT_TRUE(source.start(1'000'000));
  const std::uint64_t begin_us = source.now_us();
  ASSERT_TRUE(source.start(1000));
  EXPECT_GE(source.wait(), 1u);
  EXPECT_GE(source.now_us(), begin_us + 1000);
}

template <class Backend>
class WatchdogContract : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kTimeout_us = 20'000;
  Backend backend;
  decltype(backend.dog)& dog = backend.dog;
};
TYPED_TEST_SUITE(WatchdogContract, test::Watchdogs);

TYPED_TEST(WatchdogContract, LeavesAFedControllerAlone) {
  ASSERT_TRUE(this->dog.start(this->kTimeout_us));
  for (int i = 0; i < 100; ++i) {
    this->dog.advance(this->kTimeout_us);
    this->dog.feed();
  }
  EXPECT_FALSE(this->dog.caused_reset());
}

TYPED_TEST(WatchdogContract, ResetsAnUnfedOneNeitherEarlyNorTooLate) {
  ASSERT_TRUE(this->dog.start(this->kTimeout_us));
  this->dog.advance(this->kTimeout_us);
  EXPECT_EQ(this->dog.resets(), 0u);
  this->dog.advance((hal::kWatchdogSlack - 1) * this->kTimeout_us + 1);
  EXPECT_EQ(this->dog.resets(), 1u);
  EXPECT_TRUE(this->dog.caused_reset());
  this->dog.reset();
  EXPECT_FALSE(this->dog.caused_reset());
}

TYPED_TEST(WatchdogContract, ArmsOnceAndOnlyForWhatItCanWait) {
  EXPECT_FALSE(this->dog.start(0));
  EXPECT_FALSE(this->dog.start(0xFFFFFFFF));
  this->dog.feed();
  this->dog.advance(1'000'000'000);
  EXPECT_FALSE(this->dog.caused_reset());
  EXPECT_TRUE(this->dog.start(this->kTimeout_us));
  EXPECT_FALSE(this->dog.start(2 * this->kTimeout_us));
  this->dog.advance(hal::kWatchdogSlack * this->kTimeout_us + 1);
  EXPECT_TRUE(this->dog.caused_reset());
}

}  // namespace
}  // namespace verp
