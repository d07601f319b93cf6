#include "firmware/app/pacer.hpp"

#include <gtest/gtest.h>

#include "hal/fake/manual_clock.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp {
namespace {

constexpr std::uint32_t kPeriod_us = 10'000;

TEST(Pacer, ALoopInTimeMissesNothing) {
  hal::ManualClock clock;
  app::Pacer pacer(clock);
  ASSERT_TRUE(pacer.start(kPeriod_us));
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const app::Beat beat = pacer.next();
    EXPECT_EQ(beat.periods, 1u);
    EXPECT_FALSE(beat.overran);
    clock.advance(static_cast<std::uint64_t>(random.below(kPeriod_us + 1)));
  }
  EXPECT_EQ(pacer.deadlines().ticks, 1000u);
  EXPECT_EQ(pacer.deadlines().missed, 0u);
  EXPECT_EQ(pacer.deadlines().skipped, 0u);
  EXPECT_EQ(pacer.deadlines().worst_late_us, 0u);
}

TEST(Pacer, TheAccountIsTrueForTicksOfAnyLength) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    hal::ManualClock clock;
    clock.advance(seed * 777);
    const std::uint64_t start_us = clock.now_us();
    app::Pacer pacer(clock);
    ASSERT_TRUE(pacer.start(kPeriod_us));
    test::Random random(seed);
    std::uint64_t missed = 0, skipped = 0, worst_us = 0;
    std::uint64_t period = 1, end_us = 0;
    std::uint64_t counted = 0;
    for (int i = 0; i < 300; ++i) {
      const app::Beat beat = pacer.next();
      counted += beat.periods;
      const std::uint64_t now_us = clock.now_us();
      EXPECT_EQ(counted, (now_us - start_us) / kPeriod_us);
      if (i > 0) {
        const std::uint64_t deadline_us = start_us + (period + 1) * kPeriod_us;
        EXPECT_EQ(beat.overran, end_us > deadline_us) << "seed " << seed << " tick " << i;
        missed += end_us > deadline_us ? 1 : 0;
        skipped += counted - period - 1;
        worst_us = now_us - deadline_us > worst_us ? now_us - deadline_us : worst_us;
      }
      period = counted;
      const int most =
          random.below(10) == 0 ? 7 * static_cast<int>(kPeriod_us) : static_cast<int>(kPeriod_us);
      clock.advance(static_cast<std::uint64_t>(random.below(most)));
      end_us = clock.now_us();
    }
    EXPECT_GT(missed, 0u);
    EXPECT_GT(skipped, 0u);
    EXPECT_EQ(pacer.deadlines().missed, missed);
    EXPECT_EQ(pacer.deadlines().skipped, skipped);
    EXPECT_EQ(pacer.deadlines().worst_late_us, worst_us);
  }
}

TEST(Pacer, TheFirstTickIsNeverLate) {
  hal::ManualClock clock;
  app::Pacer pacer(clock);
  ASSERT_TRUE(pacer.start(kPeriod_us));
  clock.advance(5 * kPeriod_us + 1);
  EXPECT_FALSE(pacer.next().overran);
  EXPECT_EQ(pacer.deadlines().missed, 0u);
  EXPECT_FALSE(pacer.next().overran);
  EXPECT_FALSE(app::Pacer(clock).start(0));
}

}  // namespace
}  // namespace verp
