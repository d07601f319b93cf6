#include "host/twin/radio/radio.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace verp::radio {
namespace {

constexpr std::uint64_t kForDelay = 0, kForWait = 1, kForLoss = 2, kForFade = 3;
constexpr double kSecond_us = 1e6;

void require(bool good, const char* number, const char* how) {
  if (!good) throw std::invalid_argument(std::string("radio: ") + number + " must be " + how);
}

bool is_share(double value) {
  return value >= 0 && value <= 1;
}

}  // namespace

void check(const Conditions& c) {
  require(std::isfinite(c.range_m) && c.range_m > 0, "range_m", "above 0");
  require(is_share(c.loss), "loss", "0 to 1");
  require(is_share(c.fade), "fade", "0 to 1");
  require(c.fade_s >= 0.001 && c.fade_s <= 3600, "fade_s", "0.001 to 3600");
  require(c.delay_s >= 0 && c.delay_s <= 60, "delay_s", "0 to 60");
  require(c.jitter_s >= 0 && c.jitter_s <= 60, "jitter_s", "0 to 60");
  require(c.bytes_s >= 1 && c.bytes_s <= 1e9, "bytes_s", "1 to 1e9");
  require(c.overhead <= 10'000, "overhead", "0 to 10000");
  require(c.most_bytes >= 1 && c.most_bytes <= 65'536, "most_bytes", "1 to 65536");
  require(c.most_waiting >= 1 && c.most_waiting <= 10'000, "most_waiting", "1 to 10000");
}

Radio::Radio(const Conditions& conditions, std::uint64_t seed)
    : conditions_(conditions), seed_(seed) {
  check(conditions_);
}

int Radio::add() {
  if (numbers_ > 0) throw std::logic_error("a station joins before the first message");
  stations_.emplace_back();
  return static_cast<int>(stations_.size()) - 1;
}

sim::Random Radio::drawn(std::uint64_t number, int station, std::uint64_t use) const {
  sim::Random of_seed(seed_, sim::Draw::kRadio);
  const auto of_station = static_cast<std::uint64_t>(station) << 2 | use;
  return {of_seed.bits() ^ number, of_station};
}

std::uint64_t Radio::on_air_us(const Message& message) const {
  const auto bytes = static_cast<double>(message.data.size() + conditions_.overhead);
  return static_cast<std::uint64_t>(std::ceil(kSecond_us * bytes / conditions_.bytes_s));
}

/// Stations that wait for the same message must not start together.
std::uint64_t Radio::wait_us(const Message& message) const {
  return static_cast<std::uint64_t>(drawn(message.number, message.tries, kForWait)
                                        .uniform(0, static_cast<double>(kLongestWait_us)));
}

double Radio::distance_m(int a, int b, std::span<const Place> places) const {
  const Place& from = places[static_cast<std::size_t>(a)];
  const Place& to = places[static_cast<std::size_t>(b)];
  return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
}

Sent Radio::send(int from, int to, std::string data, std::uint64_t now_us) {
  Station& station = stations_.at(static_cast<std::size_t>(from));
  const auto refuse = [&](Sent why) {
    ++refused_;
    return why;
  };
  const auto count = static_cast<int>(stations_.size());
  if (to != kEverybody && (to < 0 || to >= count || to == from)) return refuse(Sent::kNobody);
  if (data.size() > conditions_.most_bytes) return refuse(Sent::kTooLong);
  if (station.waiting.size() >= conditions_.most_waiting) return refuse(Sent::kTooMany);
  Message message{.number = numbers_++, .from = from, .to = to, .data = std::move(data)};
  const double jitter_s = drawn(message.number, from, kForDelay).uniform(0, conditions_.jitter_s);
  message.ready_us = now_us +
                     static_cast<std::uint64_t>(kSecond_us * (conditions_.delay_s + jitter_s)) +
                     wait_us(message);
  // A station's messages never overtake each other.
  if (!station.waiting.empty())
    message.ready_us = std::max(message.ready_us, station.waiting.back().ready_us);
  station.waiting.push_back(std::move(message));
  return Sent::kOnItsWay;
}

void Radio::advance(std::uint64_t now_us, std::span<const Place> places) {
  if (places.size() != stations_.size())
    throw std::invalid_argument("radio: a place for each station");
  for (;;) {
    Station* next = nullptr;
    for (Station& each : stations_) {
      if (each.waiting.empty() || each.waiting.front().ready_us > now_us) continue;
      if (next == nullptr || each.waiting.front().ready_us < next->waiting.front().ready_us)
        next = &each;
    }
    Message* ending = nullptr;
    for (Message& each : air_) {
      if (each.over || each.over_us > now_us) continue;
      if (ending == nullptr || each.over_us < ending->over_us) ending = &each;
    }
    if (next == nullptr && ending == nullptr) return forget();
    const bool ends_first =
        ending != nullptr && (next == nullptr || ending->over_us <= next->waiting.front().ready_us);
    ends_first ? end(*ending, places) : begin(*next, places);
  }
}

/// The message that blocks the start: one that its station hears or sends now.
const Radio::Message* Radio::in_the_way(const Message& message,
                                        std::span<const Place> places) const {
  for (const Message& each : air_) {
    if (each.over || message.ready_us >= each.over_us) continue;
    if (each.from == message.from) return &each;
    const bool noticed = message.ready_us >= each.begun_us + kBlind_us;
    if (noticed && distance_m(each.from, message.from, places) <= conditions_.range_m) return &each;
  }
  return nullptr;
}

void Radio::begin(Station& station, std::span<const Place> places) {
  Message& message = station.waiting.front();
  if (const Message* other = in_the_way(message, places)) {
    ++message.tries;
    message.ready_us = other->over_us + wait_us(message);
    return;
  }
  message.begun_us = message.ready_us;
  message.over_us = message.begun_us + on_air_us(message);
  air_.push_back(std::move(message));
  station.waiting.pop_front();
  if (station.waiting.empty()) return;
  Message& next = station.waiting.front();
  next.ready_us = std::max(next.ready_us, air_.back().over_us + wait_us(next));
}

void Radio::end(Message& message, std::span<const Place> places) {
  message.over = true;
  for (int i = 0; i < static_cast<int>(stations_.size()); ++i) {
    if (i == message.from || (message.to != kEverybody && message.to != i)) continue;
    const Fate what = fate(message, i, places);
    outcomes_.push_back({.number = message.number,
                         .time_us = message.over_us,
                         .from = message.from,
                         .to = i,
                         .bytes = message.data.size(),
                         .fate = what});
    if (what == Fate::kHeard) {
      stations_[static_cast<std::size_t>(i)].heard.push_back(
          {message.from, message.data, message.number});
    }
  }
}

Fate Radio::fate(const Message& message, int station, std::span<const Place> places) const {
  const double share = distance_m(message.from, station, places) / conditions_.range_m;
  if (share > 1) return Fate::kTooFar;
  for (const Message& other : air_) {
    if (other.number == message.number) continue;
    const bool overlaps = other.begun_us < message.over_us && message.begun_us < other.over_us;
    if (!overlaps) continue;
    if (other.from == station || distance_m(other.from, station, places) <= conditions_.range_m)
      return Fate::kCollided;
  }
  if (faded(message.from, station, message.begun_us)) return Fate::kFaded;
  // Rough exponent of a hall; share is 1 at range_m.
  const double lost = 1 - (1 - conditions_.loss) * (1 - std::pow(share, 4));
  const bool hit = drawn(message.number, station, kForLoss).uniform(0, 1) < lost;
  return hit ? Fate::kLost : Fate::kHeard;
}

/// Drawn for the pair: the same in both directions.
bool Radio::faded(int a, int b, std::uint64_t time_us) const {
  const auto window =
      static_cast<std::uint64_t>(static_cast<double>(time_us) / (kSecond_us * conditions_.fade_s));
  const int pair = std::min(a, b) * 1000 + std::max(a, b);
  return drawn(window, pair, kForFade).uniform(0, 1) < conditions_.fade;
}

/// Keeps a finished message while an overlapping one is on the air.
void Radio::forget() {
  std::uint64_t earliest_us = std::numeric_limits<std::uint64_t>::max();
  for (const Message& each : air_) {
    if (!each.over) earliest_us = std::min(earliest_us, each.begun_us);
  }
  std::erase_if(air_, [&](const Message& old) { return old.over && old.over_us <= earliest_us; });
}

std::vector<ReceivedMessage> Radio::take(int station) {
  return std::exchange(stations_.at(static_cast<std::size_t>(station)).heard, {});
}

std::vector<Outcome> Radio::take_outcomes() {
  return std::exchange(outcomes_, {});
}

}  // namespace verp::radio
