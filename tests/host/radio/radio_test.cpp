#include "host/twin/radio/radio.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace verp::radio {
namespace {

/// Without chance: range, time and bytes remain.
Conditions sure() {
  Conditions c;
  c.loss = c.fade = c.jitter_s = 0;
  return c;
}

struct Row {
  Row(const Conditions& conditions, int stations, double apart_m, std::uint64_t seed = 1)
      : radio(conditions, seed) {
    for (int i = 0; i < stations; ++i) {
      radio.add();
      places.push_back({i * apart_m, 0, 0.3});
    }
  }
  std::size_t heard(int station) { return radio.take(station).size(); }
  Radio radio;
  std::vector<Place> places;
};

constexpr std::uint64_t kLate_us = 10'000'000;

TEST(Radio, EverybodyInRangeHearsABroadcastAndOneAloneWhatIsAddressed) {
  Row row(sure(), 3, 1);
  EXPECT_EQ(row.radio.send(0, kEverybody, "all", 0), Sent::kOnItsWay);
  EXPECT_EQ(row.radio.send(1, 2, "you", 100'000), Sent::kOnItsWay);
  row.radio.advance(kLate_us, row.places);
  EXPECT_EQ(row.heard(0), 0u);
  EXPECT_EQ(row.heard(1), 1u);
  const std::vector<ReceivedMessage> last = row.radio.take(2);
  ASSERT_EQ(last.size(), 2u);
  EXPECT_EQ(last[0].data, "all");
  EXPECT_EQ(last[0].from, 0);
  EXPECT_EQ(last[1].data, "you");
  EXPECT_EQ(last[1].from, 1);
}

TEST(Radio, NothingIsHeardBeyondItsRange) {
  Conditions c = sure();
  c.range_m = 5;
  Row row(c, 3, 4.9);  // the third is 9.8 m away
  row.radio.send(0, kEverybody, "x", 0);
  row.radio.advance(kLate_us, row.places);
  std::vector<Outcome> outcomes = row.radio.take_outcomes();
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_NE(outcomes[0].fate, Fate::kTooFar);
  EXPECT_EQ(outcomes[1].fate, Fate::kTooFar);
  EXPECT_EQ(row.heard(2), 0u);
}

TEST(Radio, AMessageThatIsTooLongOrHasNoRoomOrNobodyToHearItIsRefused) {
  Conditions c = sure();
  c.most_bytes = 10;
  c.most_waiting = 2;
  Row row(c, 2, 1);
  EXPECT_EQ(row.radio.send(0, kEverybody, std::string(11, 'x'), 0), Sent::kTooLong);
  EXPECT_EQ(row.radio.send(0, 2, "x", 0), Sent::kNobody);
  EXPECT_EQ(row.radio.send(0, 0, "x", 0), Sent::kNobody);
  EXPECT_EQ(row.radio.send(0, kEverybody, std::string(10, 'x'), 0), Sent::kOnItsWay);
  EXPECT_EQ(row.radio.send(0, 1, "x", 0), Sent::kOnItsWay);
  EXPECT_EQ(row.radio.send(0, 1, "x", 0), Sent::kTooMany);
  EXPECT_EQ(row.radio.sent(), 2u);
  EXPECT_EQ(row.radio.refused(), 4u);
  row.radio.advance(kLate_us, row.places);
  EXPECT_EQ(row.heard(1), 2u);
}

TEST(Radio, AMessageTakesItsDelayAndItsBytesTime) {
  Conditions c = sure();
  c.delay_s = 0.020;
  c.bytes_s = 1000;
  c.overhead = 10;
  Row row(c, 2, 1);
  row.radio.send(0, kEverybody, std::string(30, 'x'), 1'000);  // 20 ms, its wait, 40 bytes
  row.radio.advance(60'999, row.places);
  EXPECT_EQ(row.heard(1), 0u);
  row.radio.advance(61'000 + Radio::kLongestWait_us, row.places);
  EXPECT_EQ(row.heard(1), 1u);
}

TEST(Radio, JitterSpreadsDelaysOverAllOfIt) {
  Conditions c = sure();
  c.delay_s = 0.010;
  c.jitter_s = 0.030;
  c.overhead = 0;
  c.bytes_s = 1e6;
  Row row(c, 2, 1);
  constexpr int kMessages = 400;
  double least_s = 1, most_s = 0, sum_s = 0;
  for (int i = 0; i < kMessages; ++i) {
    const std::uint64_t at_us = static_cast<std::uint64_t>(i) * 100'000;
    row.radio.send(0, kEverybody, "x", at_us);
    row.radio.advance(at_us + 99'999, row.places);
    const auto outcomes = row.radio.take_outcomes();
    ASSERT_EQ(outcomes.size(), 1u);
    const double took_s = 1e-6 * static_cast<double>(outcomes[0].time_us - at_us);
    least_s = std::min(least_s, took_s);
    most_s = std::max(most_s, took_s);
    sum_s += took_s;
  }
  EXPECT_NEAR(least_s, 0.010, 0.001);
  EXPECT_NEAR(most_s, 0.042, 0.001);  // with the wait before sending
  EXPECT_NEAR(sum_s / kMessages, 0.026, 0.002);
}

TEST(Radio, StationsShareTheAir) {
  Conditions c = sure();
  c.bytes_s = 10'000;
  c.overhead = 0;
  c.most_bytes = 100;
  constexpr int kStations = 4;
  Row row(c, kStations, 1);
  constexpr double kLong_s = 20;
  constexpr std::uint64_t kLong_us = 20'000'000;
  for (std::uint64_t at_us = 0; at_us < kLong_us; at_us += 5'000) {
    for (int i = 0; i < kStations; ++i) row.radio.send(i, kEverybody, std::string(100, 'x'), at_us);
    row.radio.advance(at_us, row.places);
  }
  double bytes = 0;
  std::size_t collided = 0;
  for (const Outcome& each : row.radio.take_outcomes()) {
    if (each.fate == Fate::kHeard) bytes += static_cast<double>(each.bytes) / (kStations - 1);
    collided += each.fate == Fate::kCollided;
  }
  EXPECT_LT(bytes / kLong_s, 10'000);
  EXPECT_GT(bytes / kLong_s, 4'000);  // waiting and collisions take the rest
  EXPECT_GT(collided, 0u);            // within kBlind_us
  EXPECT_GT(row.radio.refused(), 0u);
}

// The middle one hears both.
TEST(Radio, HiddenStationsCollideWhereBothAreHeard) {
  Conditions c = sure();
  c.range_m = 5;
  Row row(c, 3, 4);
  row.radio.send(0, kEverybody, std::string(50, 'a'), 0);
  row.radio.send(2, kEverybody, std::string(50, 'b'), 500);
  row.radio.advance(kLate_us, row.places);
  EXPECT_EQ(row.heard(1), 0u);
  int collided = 0;
  for (const Outcome& each : row.radio.take_outcomes())
    collided += each.to == 1 && each.fate == Fate::kCollided;
  EXPECT_EQ(collided, 2);
}

TEST(Radio, OneListensBeforeItTalks) {
  Row row(sure(), 3, 1);
  row.radio.send(0, kEverybody, std::string(90, 'a'), 0);
  row.radio.send(1, kEverybody, std::string(90, 'b'), 1'000);
  row.radio.advance(kLate_us, row.places);
  EXPECT_EQ(row.heard(2), 2u);
}

/// Each broadcast is alone on the air.
double lost_share(const Conditions& c, double apart_m, int messages, std::uint64_t seed = 1) {
  Row row(c, 2, apart_m, seed);
  for (int i = 0; i < messages; ++i) {
    const std::uint64_t at_us = static_cast<std::uint64_t>(i) * 50'000;
    row.radio.send(0, kEverybody, "x", at_us);
    row.radio.advance(at_us + 49'999, row.places);
  }
  return 1 - static_cast<double>(row.heard(1)) / messages;
}

TEST(Radio, LosesItsShareAndMoreTheFurtherAway) {
  constexpr int kMany = 20'000;
  Conditions c = sure();
  c.range_m = 10;
  c.loss = 0.2;
  const double sigma = std::sqrt(0.2 * 0.8 / kMany);
  EXPECT_NEAR(lost_share(c, 0.01, kMany), 0.2, 4 * sigma);
  const double at_half = 1 - 0.8 * (1 - std::pow(0.5, 4));
  EXPECT_NEAR(lost_share(c, 5, kMany), at_half, 4 * sigma);
  EXPECT_EQ(lost_share(c, 10, 1000), 1);
  c.loss = 0;
  EXPECT_LT(lost_share(c, 0.01, 1000), 0.005);
}

TEST(Radio, FadesForAStretchAndThatShareOfTheTime) {
  constexpr int kMany = 40'000;  // 50 ms apart: 5,000 stretches
  Conditions c = sure();
  c.fade = 0.1;
  c.fade_s = 0.4;
  EXPECT_NEAR(lost_share(c, 1, kMany), 0.1, 4 * std::sqrt(0.1 * 0.9 / 5000));
  // A message after a lost one is usually lost.
  Row row(c, 2, 1);
  int pairs = 0, lost = 0;
  bool before = false;
  for (int i = 0; i < kMany; ++i) {
    const std::uint64_t at_us = static_cast<std::uint64_t>(i) * 50'000;
    row.radio.send(0, kEverybody, "x", at_us);
    row.radio.advance(at_us + 49'999, row.places);
    const bool now = row.heard(1) == 0;
    lost += before;
    pairs += before && now;
    before = now;
  }
  EXPECT_GT(static_cast<double>(pairs) / lost, 0.8);
}

std::vector<Outcome> outcomes_of(std::uint64_t seed, int stations) {
  Conditions c;
  c.loss = 0.3;
  c.fade = 0.1;
  Row row(c, stations, 0.5, seed);
  for (std::uint64_t at_us = 0; at_us < 20'000'000; at_us += 40'000) {
    row.radio.send(0, kEverybody, "from the first", at_us);
    row.radio.send(1, kEverybody, "from the second", at_us + 20'000);
    row.radio.advance(at_us + 20'000, row.places);
  }
  return row.radio.take_outcomes();
}

bool same(const Outcome& a, const Outcome& b) {
  return a.number == b.number && a.time_us == b.time_us && a.from == b.from && a.to == b.to &&
         a.fate == b.fate;
}

TEST(Radio, IsAFunctionOfItsSeed) {
  const std::vector<Outcome> one = outcomes_of(7, 2), again = outcomes_of(7, 2),
                             other = outcomes_of(8, 2);
  ASSERT_EQ(one.size(), again.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_TRUE(same(one[i], again[i])) << i;
    different += i < other.size() && !same(one[i], other[i]);
  }
  EXPECT_GT(different, one.size() / 10);
}

TEST(Radio, OneMoreStationThatListensChangesNobodysLuck) {
  const std::vector<Outcome> two = outcomes_of(7, 2);
  std::vector<Outcome> three = outcomes_of(7, 3);
  std::erase_if(three, [](const Outcome& each) { return each.to == 2; });
  ASSERT_EQ(two.size(), three.size());
  for (std::size_t i = 0; i < two.size(); ++i) ASSERT_TRUE(same(two[i], three[i])) << i;
}

TEST(Radio, RefusesNumbersThatAreOfNoRadio) {
  const std::function<void(Conditions&)> spoil[] = {
      [](Conditions& c) { c.range_m = 0; },        [](Conditions& c) { c.range_m = NAN; },
      [](Conditions& c) { c.loss = 1.1; },         [](Conditions& c) { c.loss = NAN; },
      [](Conditions& c) { c.fade = -0.1; },        [](Conditions& c) { c.fade_s = 0; },
      [](Conditions& c) { c.delay_s = -1; },       [](Conditions& c) { c.jitter_s = 61; },
      [](Conditions& c) { c.bytes_s = 0; },        [](Conditions& c) { c.most_bytes = 0; },
      [](Conditions& c) { c.overhead = 100'000; }, [](Conditions& c) { c.most_waiting = 0; }};
  for (const auto& each : spoil) {
    Conditions c;
    each(c);
    EXPECT_THROW(Radio(c, 1), std::invalid_argument);
  }
  EXPECT_NO_THROW(Radio(Conditions{}, 1));
}

}  // namespace
}  // namespace verp::radio
