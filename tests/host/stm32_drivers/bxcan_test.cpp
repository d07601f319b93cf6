#include "hal/chip/stm32/bxcan.hpp"

#include <set>
#include <vector>

#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/can_rig.hpp"

// Beyond hal/contract/can_bus.hpp, whose suite runs too.

namespace verp::hal::stm32::test {
namespace {

CanFrame frame_of(std::uint32_t id, unsigned number = 0) {
  CanFrame frame;
  frame.id = id;
  frame.size = 8;
  for (unsigned i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(number + i);
  return frame;
}

/// A quarter of 168, 180 and 216 MHz.
constexpr std::uint32_t kApb1_hz[] = {42'000'000, 45'000'000, 54'000'000};
/// CiA 301's rates that are used here.
constexpr std::uint32_t kRates[] = {1'000'000, 500'000, 250'000, 125'000};

TEST(BxCanTiming, IsExactAndSamplesWhereCanopenWantsItOnEverySupportedClock) {
  for (const std::uint32_t clock_hz : kApb1_hz) {
    for (const std::uint32_t bitrate : kRates) {
      BxCanTiming timing;
      ASSERT_TRUE(choose_bxcan_timing(clock_hz, bitrate, timing)) << clock_hz << " " << bitrate;
      const std::uint32_t quanta = 1 + timing.before + timing.after;
      EXPECT_EQ(std::uint64_t{timing.prescaler} * quanta * bitrate, clock_hz);
      const double sample = static_cast<double>(1 + timing.before) / quanta;
      EXPECT_GE(sample, 0.85) << clock_hz << " " << bitrate;
      EXPECT_LE(sample, 0.90) << clock_hz << " " << bitrate;
      EXPECT_LE(timing.jump, timing.after);
      EXPECT_TRUE(quanta >= 8 && quanta <= 25 && timing.before <= 16 && timing.after <= 8);
    }
  }
}

TEST(BxCanTiming, RefusesARateThatTheClockDoesNotMakeExactly) {
  BxCanTiming timing;
  EXPECT_FALSE(choose_bxcan_timing(42'000'000, 800'000, timing)) << "52.5 clocks a bit";
  EXPECT_FALSE(choose_bxcan_timing(42'000'000, 0, timing));
  EXPECT_FALSE(choose_bxcan_timing(42'000'000, 2'000'000, timing));
  EXPECT_FALSE(choose_bxcan_timing(1'000'000, 1'000'000, timing)) << "a bit has 8 quanta at least";
  EXPECT_EQ(timing.clock_hz, 0u);
}

TEST(CanMailbox, ReadsALengthCodeAboveEightAsEight) {
  for (std::uint32_t code = 0; code < 16; ++code) {
    const CanFrame frame = CanReceived{0, code, 0x03020100, 0x07060504}.frame();
    EXPECT_EQ(frame.size, code < 8 ? code : 8);
    for (unsigned i = 0; i < frame.size; ++i) EXPECT_EQ(frame.data[i], i);
  }
}

class BxCanDriver : public EachFamily {
 protected:
  CanRig board{GetParam()};
  model::CanModel& can = board.can;
  Can& driver = board.driver;

  void advance(std::uint64_t time_us) { board.rig.machine.advance(us(time_us)); }
  std::vector<std::uint32_t> ids() const {
    std::vector<std::uint32_t> all;
    for (const auto& each : can.sent()) all.push_back(each.frame.id);
    return all;
  }
};
INSTANTIATE_TEST_SUITE_P(Chips, BxCanDriver, kFamilies, name_of);

TEST_P(BxCanDriver, MakesTheRateAndSamplePointThatItWasAskedFor) {
  EXPECT_NEAR(can.bitrate(), 1e6, 1);
  EXPECT_GE(can.sample_point(), 0.85);
  EXPECT_LE(can.sample_point(), 0.90);
}

TEST_P(BxCanDriver, SendsTheBestFirstWhateverWaits) {
  can.send(frame_of(0x001));  // holds the bus
  advance(5);
  for (std::uint32_t i = 0; i < 10; ++i) ASSERT_TRUE(driver.send(frame_of(0x600 - i)));
  ASSERT_TRUE(driver.send(frame_of(0x080)));
  CanFrame heard;
  EXPECT_TRUE(driver.poll(heard, 10'000));
  EXPECT_FALSE(driver.poll(heard, 10'000));
  std::vector<std::uint32_t> want = {0x080};
  for (std::uint32_t id = 0x5F7; id <= 0x600; ++id) want.push_back(id);
  EXPECT_EQ(ids(), want);
}

TEST_P(BxCanDriver, KeepsTheOrderOfEachIdentifierAndSendsNothingTwice) {
  std::uint32_t seed = 3;
  const auto next = [&] { return (seed = seed * 1664525u + 1013904223u) >> 8; };
  constexpr std::uint32_t kIds = 5;
  std::vector<unsigned> accepted[kIds];
  for (unsigned i = 0; i < 400; ++i) {
    const std::uint32_t id = next() % kIds;
    if (driver.send(frame_of(0x100 + id, i))) accepted[id].push_back(i % 256);
    if (next() % 4 == 0) can.send(frame_of(0x050 + next() % 0x200));
    advance(next() % 200);
    CanFrame heard;
    while (driver.poll(heard, 0)) {
    }
  }
  advance(20'000);
  std::vector<unsigned> left[kIds];
  for (const auto& each : can.sent()) left[each.frame.id - 0x100].push_back(each.frame.data[0]);
  for (std::uint32_t id = 0; id < kIds; ++id) {
    EXPECT_GT(accepted[id].size(), 40u);
    EXPECT_EQ(left[id], accepted[id]) << id;
  }
}

TEST_P(BxCanDriver, UsesAllMailboxes) {
  std::set<unsigned> used;
  can.send(frame_of(0x001));
  advance(5);
  for (std::uint32_t i = 0; i < 6; ++i) ASSERT_TRUE(driver.send(frame_of(0x100 + i)));
  advance(2000);
  for (const auto& each : can.sent()) used.insert(each.mailbox);
  EXPECT_EQ(used.size(), 3u);
}

// Interrupts are masked; the FIFO holds three.
TEST_P(BxCanDriver, CountsAFifoOverrunAndKeepsTheOldest) {
  {
    const Masked<Io> masked(board.rig.machine.io());
    for (unsigned i = 0; i < 4; ++i) can.send(frame_of(0x181, i));
    advance(1000);
  }
  advance(10);
  CanFrame heard;
  for (unsigned i = 0; i < 3; ++i) {
    ASSERT_TRUE(driver.poll(heard, 0));
    EXPECT_TRUE(heard == frame_of(0x181, i)) << i;
  }
  EXPECT_FALSE(driver.poll(heard, 0));
  EXPECT_EQ(driver.errors().overruns, 1u);
}

TEST_P(BxCanDriver, CountsWhatNobodyFetchedInTime) {
  for (unsigned i = 0; i < Can::kInbox + 10; ++i) can.send(frame_of(0x181, i));
  advance(200 * Can::kInbox);
  EXPECT_EQ(driver.errors().overruns, 10u);
  CanFrame heard;
  for (unsigned i = 0; i < Can::kInbox; ++i) {
    ASSERT_TRUE(driver.poll(heard, 0));
    EXPECT_TRUE(heard == frame_of(0x181, i)) << i;
  }
  EXPECT_FALSE(driver.poll(heard, 0));
}

// 32 failures, then 128 times 11 bits of silence.
TEST_P(BxCanDriver, ComesBackFromBusOffAfterTheTimeOfTheStandard) {
  can.break_next = 32;
  ASSERT_TRUE(driver.send(frame_of(0x123)));
  model::Time off_at = 0;
  for (int i = 0; i < 10'000 && driver.errors().bus_offs == 0; ++i) {
    advance(1);
    off_at = board.rig.machine.now();
  }
  ASSERT_EQ(driver.errors().bus_offs, 1u);
  EXPECT_EQ(driver.errors().errors, 32u);
  EXPECT_EQ(driver.errors().dropped, 1u);
  bool back = false;
  while (!back && board.rig.machine.now() < off_at + ms(5)) {
    back = driver.send(frame_of(0x200));
    if (!back) advance(1);
  }
  ASSERT_TRUE(back);
  const auto away_us = static_cast<double>(board.rig.machine.now() - off_at) / 1e6;
  EXPECT_NEAR(away_us, 128 * 11, 20);
  advance(1000);
  EXPECT_EQ(ids(), std::vector<std::uint32_t>{0x200}) << "what was dropped stays so";
}

TEST_P(BxCanDriver, GoesOnWhileNobodyAcknowledgesAndSendsOnceSomebodyDoes) {
  can.acknowledged = false;
  ASSERT_TRUE(driver.send(frame_of(0x700)));
  advance(20'000);
  EXPECT_EQ(driver.errors().bus_offs, 0u) << "a passive node that is alone stays on the bus";
  EXPECT_GT(driver.errors().errors, 16u);
  can.acknowledged = true;
  advance(1000);
  EXPECT_EQ(ids(), std::vector<std::uint32_t>{0x700});
}

TEST_P(BxCanDriver, SaysWhenAFrameEndedNotWhenItWasFetched) {
  advance(100);
  const std::uint64_t before_us = driver.now_us();
  can.send(frame_of(0x181));
  advance(5000);
  CanFrame heard;
  ASSERT_TRUE(driver.poll(heard, 0));
  EXPECT_NEAR(static_cast<double>(driver.now_us()), static_cast<double>(before_us + 111), 8);
}

TEST_P(BxCanDriver, CountsTheTimeoutFromWhenTheLastFrameBegan) {
  for (std::uint32_t i = 0; i < 20; ++i) ASSERT_TRUE(driver.send(frame_of(0x100 + i)));
  CanFrame heard;
  EXPECT_FALSE(driver.poll(heard, 500));
  ASSERT_EQ(can.sent().size(), 20u);
  const auto since_us =
      static_cast<double>(board.rig.machine.now() - can.sent().back().start) / 1e6;
  EXPECT_NEAR(since_us, 500, 20);
}

TEST_P(BxCanDriver, LetsInWhatItsRulesSayAndNothingElse) {
  Can filtered(base::kCan1, board.rig.timer, board.rig.machine.io());
  const CanFilterRule rules[] = {{0x180, 0x780, false}, {0x1ABCD, 0x1FFFFFFF, true}};
  ASSERT_TRUE(filtered.open(board.rig.clocks, kBxCanTiming, rules, 2));
  for (unsigned line = irq::kCan1Tx; line <= irq::kCan1Error; ++line) {
    board.rig.machine.attach(line, [&] { filtered.on_interrupt(); });
  }
  CanFrame extended = frame_of(0x1ABCD);
  extended.extended = true;
  CanFrame other = extended;
  other.id = 0x185 << 18;  // begins like 0x185
  for (const CanFrame& each : {frame_of(0x17F), frame_of(0x180), frame_of(0x1FF), frame_of(0x200),
                               extended, other, frame_of(0x5CD)}) {
    can.send(each);
  }
  advance(2000);
  CanFrame heard;
  // All frames were ready at once.
  for (const CanFrame& each : {extended, frame_of(0x180), frame_of(0x1FF)}) {
    ASSERT_TRUE(filtered.poll(heard, 0));
    EXPECT_TRUE(heard == each) << each.id;
  }
  EXPECT_FALSE(filtered.poll(heard, 0));
  const CanFilterRule many[Can::kRules + 1] = {};
  EXPECT_FALSE(filtered.open(board.rig.clocks, kBxCanTiming, many, Can::kRules + 1));
}

TEST_P(BxCanDriver, RefusesAClockThatIsNotACrystals) {
  Clocks clocks = board.rig.clocks;
  for (const ClockSource source :
       {ClockSource::kInternalPll, ClockSource::kInternal, ClockSource::kAbsent}) {
    clocks.source = source;
    EXPECT_FALSE(driver.open(clocks, kBxCanTiming));
  }
  clocks = board.rig.clocks;
  clocks.apb1_hz = 45'000'000;
  EXPECT_FALSE(driver.open(clocks, kBxCanTiming)) << "the timing is another clock's";
  EXPECT_FALSE(driver.open(board.rig.clocks, BxCanTiming{}));
}

TEST_P(BxCanDriver, GivesUpWhenInitialisationNeverBegins) {
  can.init_stuck = true;
  const model::Time before = board.rig.machine.now();
  EXPECT_FALSE(driver.open(board.rig.clocks, kBxCanTiming));
  EXPECT_LT(board.rig.machine.now() - before, ms(25));
  EXPECT_EQ(driver.stuck(), 1u);
}

TEST_P(BxCanDriver, RefusesFramesOnALineThatIsNeverIdle) {
  can.line_dominant = true;
  const model::Time before = board.rig.machine.now();
  EXPECT_TRUE(driver.open(board.rig.clocks, kBxCanTiming)) << "the bus may heal";
  EXPECT_LT(board.rig.machine.now() - before, ms(5));
  EXPECT_FALSE(driver.send(frame_of(1)));
  CanFrame heard;
  EXPECT_FALSE(driver.poll(heard, 1000));
}

}  // namespace
}  // namespace verp::hal::stm32::test
