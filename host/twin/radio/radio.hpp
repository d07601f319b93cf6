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

/// Defaults: an IEEE 802.15.4 modem (250 kbit/s, frames of at most 127 bytes) in a hall.
/// host/guide/walk.md lists what the model omits.
struct Conditions {
  double range_m = 30;            ///< no reception beyond
  double loss = 0.02;             ///< at short range; all are lost at range_m
  double fade = 0.02;             ///< share of time that a pair is disconnected,
  double fade_s = 0.3;            ///< for this long at a time
  double delay_s = 0.004;         ///< from send() to the air,
  double jitter_s = 0.004;        ///< plus at most this
  double bytes_s = 31'250;        ///< shared by all within range_m
  std::size_t overhead = 31;      ///< bytes per message
  std::size_t most_bytes = 96;    ///< longer messages are refused
  std::size_t most_waiting = 16;  ///< per station; further messages are refused

  bool operator==(const Conditions&) const = default;
};

/// Throws std::invalid_argument with the name of the first invalid number.
void check(const Conditions& conditions);

using Place = std::array<double, 3>;  ///< antenna position, m

inline constexpr int kEverybody = -1;

struct ReceivedMessage {
  int from = 0;
  std::string data;
  std::uint64_t number = 0;
};

enum class Sent { kOnItsWay, kTooLong, kTooMany, kNobody };  ///< kNobody: there is no such station

enum class Fate { kHeard, kTooFar, kCollided, kFaded, kLost };
inline constexpr int kFates = 5;
inline constexpr const char* kFateNames[kFates] = {"heard", "too far", "collided", "faded", "lost"};

/// Fate of a message at one addressed station.
struct Outcome {
  std::uint64_t number = 0, time_us = 0;  ///< end of its last byte
  int from = 0, to = 0;
  std::size_t bytes = 0;  ///< payload
  Fate fate = Fate::kHeard;
};

/// Broadcast or addressed messages, without acknowledgement or repeat. A station listens before it
/// sends. Two messages collide where both are heard if they begin within kBlind_us of each other or
/// their senders do not hear each other. Random draws depend only on the seed, the message number
/// and the two stations.
class Radio {
 public:
  /// Throws as check() does.
  Radio(const Conditions& conditions, std::uint64_t seed);

  /// Stations count from 0; add all before the first message.
  int add();
  std::size_t stations() const { return stations_.size(); }

  /// Time must not go backwards, here or in advance().
  Sent send(int from, int to, std::string data, std::uint64_t now_us);
  void advance(std::uint64_t now_us, std::span<const Place> places);
  /// Messages in order of arrival, up to the last advance().
  std::vector<ReceivedMessage> take(int station);

  std::vector<Outcome> take_outcomes();
  std::uint64_t sent() const { return numbers_; }
  /// Messages that send() refused.
  std::uint64_t refused() const { return refused_; }
  const Conditions& conditions() const { return conditions_; }

  /// A message younger than this is not heard: an 802.15.4 radio needs 8 symbols of 16 us to detect
  /// it and 12 to turn to sending.
  static constexpr std::uint64_t kBlind_us = 320;
  /// Longest random wait before sending (7 units of 20 symbols).
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
    std::vector<ReceivedMessage> heard;
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
  std::deque<Message> air_;
  std::vector<Outcome> outcomes_;
  std::uint64_t numbers_ = 0, refused_ = 0;
};

}  // namespace verp::radio
