#include <gtest/gtest.h>

#include <vector>

#include "host/os/link/scip.hpp"
#include "host/os/link/scip_range_finder.hpp"
#include "tests/support/scip_sensor.hpp"

// By the specification, with a laser on a pseudo-terminal.

namespace verp::link {
namespace {

void add(scip::Replies& replies, std::string_view text) {
  replies.add(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

TEST(Scip, DecodesAndSumsAsTheSpecificationsExamples) {
  // Section 6: 1234 is CB, 5432 is 1Dh, 16000000 is m2@0. Section 7: the sum of Hokuyo is o.
  EXPECT_EQ(scip::decoded("CB"), 1234u);
  EXPECT_EQ(scip::decoded("1Dh"), 5432u);
  EXPECT_EQ(scip::decoded("m2@0"), 16000000u);
  EXPECT_EQ(scip::decoded("1 h"), std::nullopt);
  EXPECT_EQ(scip::sum_of("Hokuyo"), 'o');
  EXPECT_EQ(scip::sum_of("00"), 'P');
  EXPECT_EQ(scip::sum_of("99"), 'b');
}

TEST(Scip, FindsRepliesByteByByteAndLeavesDamagedOnesOut) {
  const std::string good = "BM\n00P\n\n", bad = "BM\n00Q\n\n";
  scip::Replies replies;
  int found = 0;
  for (const char c : "noise" + good + bad + good) {
    add(replies, {&c, 1});
    while (replies.next()) ++found;
  }
  EXPECT_EQ(found, 2);
  EXPECT_EQ(replies.damaged(), 1u);
  add(replies, std::string(10000, 'x'));
  EXPECT_FALSE(replies.next());
  EXPECT_EQ(replies.damaged(), 2u);
  add(replies, good);
  EXPECT_TRUE(replies.next());
}

struct Bench {
  Link near{parse_endpoint("pty:")};
  Link far{parse_endpoint("serial:" + near.place() + "@115200")};
  test::ScipSensor<Link> sensor{far};
  ScipRangeFinder<Link> finder;
  hal::RangeScan scan;

  /// A busy PC must not look like a silent sensor.
  explicit Bench(std::uint32_t silent_ms = 60'000)
      : finder(near, {.first = 0, .last = 99, .least_mm = 20, .silent_ms = silent_ms}) {}

  hal::RangeStatus read() {
    for (int i = 0; i < 5000; ++i) {
      sensor.listen();
      if (const auto status = finder.read(scan); status != hal::RangeStatus::kStale) return status;
      sleep_until_ns(monotonic_ns() + 1'000'000);
    }
    return hal::RangeStatus::kStale;
  }
  void start() {
    for (int i = 0; i < 5000 && !sensor.scanning(); ++i) {
      finder.read(scan);
      sensor.listen();
      sleep_until_ns(monotonic_ns() + 1'000'000);
    }
    ASSERT_TRUE(sensor.scanning());
  }
};

TEST(ScipRangeFinder, ReadsScansOverAPseudoTerminal) {
  Bench bench;
  bench.start();
  std::vector<std::uint32_t> ranges(100);
  for (std::uint32_t i = 0; i < 100; ++i) ranges[i] = 100 + 37 * i;
  ranges[3] = 19;      // an error code
  ranges[4] = 100000;  // beyond 16 bits
  for (std::uint32_t turn = 1; turn <= 5; ++turn) {
    ranges[0] = 1000 + turn;
    bench.sensor.scan(100 * turn, ranges);
    ASSERT_EQ(bench.read(), hal::RangeStatus::kFresh);
    EXPECT_EQ(bench.scan.steps, 100u);
    EXPECT_EQ(bench.scan.range_mm[0], 1000 + turn);
    EXPECT_EQ(bench.scan.range_mm[3], 0);
    EXPECT_EQ(bench.scan.range_mm[4], 0);
    EXPECT_EQ(bench.scan.range_mm[99], 100 + 37 * 99);
    EXPECT_EQ(bench.scan.time_us, 100'000u * turn);
  }
  EXPECT_EQ(bench.finder.faults(), 0u);
  EXPECT_EQ(bench.finder.damaged(), 0u);
}

TEST(ScipRangeFinder, AsksAnewWhenTheSensorWasSilent) {
  Bench bench(50);
  bench.start();
  bench.sensor.be_silent(true);
  EXPECT_EQ(bench.read(), hal::RangeStatus::kFault);
  EXPECT_GE(bench.finder.faults(), 1u);
  bench.sensor.be_silent(false);
  bench.start();
  for (int turn = 0; turn < 1000; ++turn) {
    bench.sensor.scan(7, std::vector<std::uint32_t>(100, 500));
    if (bench.finder.read(bench.scan) == hal::RangeStatus::kFresh) break;
  }
  EXPECT_EQ(bench.scan.range_mm[50], 500);
}

TEST(ScipRangeFinder, TellsWhatTheSensorRefused) {
  Bench bench;
  bench.start();
  bench.sensor.say("MD0000009901000\n50" + std::string(1, scip::sum_of("50")) + "\n\n");
  EXPECT_EQ(bench.read(), hal::RangeStatus::kFault);
  EXPECT_EQ(bench.finder.last_complaint(), "MD0000009901000 50");
}

}  // namespace
}  // namespace verp::link
