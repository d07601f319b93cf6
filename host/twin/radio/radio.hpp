#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "host/twin/sim/random.hpp"

namespace verp::radio {

/// What a modem and the air do to messages. Defaults: an IEEE 802.15.4 modem (250 kbit/s, frames of
/// at most 127 bytes) behind a serial port, in a hall. host/guide/walk.md says what is left out.
struct Conditions {
  double range_m = 30;      ///< nothing is heard beyond
  double loss = 0.02;       ///< share of messages lost beside the sender; all are at range_m
  double fade = 0.02;       ///< share of the time in which two stations hear nothing of each other,
  double fade_s = 0.3;      ///< at a stretch
  double delay_s = 0.004;   ///< from send() until a message could be on the air,
  double jitter_s = 0.004;  ///< and at most so much more
  double bytes_s = 31'250;  ///< on the air, which all within range_m share
  std::size_t overhead = 31;      ///< bytes that every message has besides its own
  std::size_t most_bytes = 96;    ///< of a message; a longer one is refused
  std::size_t most_waiting = 16;  ///< messages of one station; a further one is refused
};

/// Throws std::invalid_argument, naming the number, unless all are of a radio.
void check(const Conditions& conditions);

using Place = std::array<double, 3>;  ///< of an antenna, m

inline constexpr int kEverybody = -1;

/// What a station is given.
struct Heard {
  int from = 0;
  std::string data;
  std::uint64_t number = 0;  ///< of the message, as send() counts: for records
};

enum class Sent { kOnItsWay, kTooLong, kTooMany, kNobody };  ///< kNobody: there is no such station

enum class Fate { kHeard, kTooFar, kCollided, kFaded, kLost };
inline constexpr int kFates = 5;
inline constexpr const char* kFateNames[kFates] = {"heard", "too far", "collided", "faded", "lost"};

/// What became of a message at one station that it was for.
struct Outcome {
  std::uint64_t number = 0, time_us = 0;  ///< when its last byte was over
  int from = 0, to = 0;
  std::size_t bytes = 0;  ///< of its own
  Fate fate = Fate::kHeard;
};

/// Messages between stations: broadcast or addressed, never acknowledged and never sent again by
/// the radio itself. A station listens before it talks; two that begin within kBlind_us of each
/// other, or do not hear each other, collide where both are heard, and who talks hears nobody.
/// All that is drawn comes from the seed, the message's number and the two stations alone, so that
/// equal runs are equal and one more station shifts no other's luck.
class Radio {
 public:
  /// Throws as check() does.
  Radio(const Conditions& conditions, std::uint64_t seed);

  /// One more; they count from 0. Before the first message.
  int add();
  std::size_t stations() const { return stations_.size(); }

  /// Time must not go back, here and in advance().
  Sent send(int from, int to, std::string data, std::uint64_t now_us);
  /// All that is over by now; `places` has where each station's antenna is.
  void advance(std::uint64_t now_us, std::span<const Place> places);
  /// What that station heard up to the last advance(), in the order in which it came.
  std::vector<Heard> take(int station);

  /// Of all messages that are over, since it was last asked.
  std::vector<Outcome> take_outcomes();
  std::uint64_t sent() const { return numbers_; }
  /// Given to send() and not taken.
  std::uint64_t refused() const { return refused_; }
  const Conditions& conditions() const { return conditions_; }

  /// Who has begun for less than this is not heard yet: the time of an 802.15.4 radio to find out
  /// (8 symbols of 16 us) and to turn from listening to talking (12).
  static constexpr std::uint64_t kBlind_us = 320;
  /// And waits for up to so long before it talks (7 units of 20 symbols).
  static constexpr std::uint64_t kLongestWait_us = 2240;

 private:
  struct Message {
    std::uint64_t number = 0, ready_us = 0, begun_us = 0, over_us = 0;
    int from = 0, to = kEverybody, tries = 0;
    bool over = false;
    std::string data;
  };
  struct Station {
    std::deque<Message> waiting;
    std::vector<Heard> heard;
  };

  std::uint64_t on_air_us(const Message& message) const;
  std::uint64_t wait_us(const Message& message) const;
  sim::Random drawn(std::uint64_t number, int station, std::uint64_t use) const;
  double distance_m(int a, int b, std::span<const Place> places) const;
  const Message* in_the_way(const Message& message, std::span<const Place> places) const;
  void begin(Station& station, std::span<const Place> places);
  void end(Message& message, std::span<const Place> places);
  Fate fate(const Message& message, int station, std::span<const Place> places) const;
  bool faded(int a, int b, std::uint64_t time_us) const;
  void forget();

  const Conditions conditions_;
  const std::uint64_t seed_;
  std::vector<Station> stations_;
  std::deque<Message> air_;  ///< that are on it, or overlapped one that is
  std::vector<Outcome> outcomes_;
  std::uint64_t numbers_ = 0, refused_ = 0;
};

}  // namespace verp::radio
