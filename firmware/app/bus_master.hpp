#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/bus_counters.hpp"
#include "firmware/app/schedule.hpp"
#include "hal/contract/frame_bus.hpp"

/// Requests and replies over a FrameBus. A lost reply costs at most its timeout. A late reply is
/// dropped before the next request; an even later one has a wrong length if similar requests add
/// spare_bytes().
namespace verp::app {

enum class Take { kStray, kMore, kDone };

class BusMaster {
 public:
  explicit BusMaster(hal::FrameBus& bus) : bus_(bus) {}

  std::uint8_t* frame() { return tx_; }  ///< build requests here
  static constexpr std::size_t capacity() { return sizeof tx_; }
  std::uint64_t now_us() { return bus_.now_us(); }
  const BusCounters& counters() const { return counters_; }
  std::uint32_t crc_errors() const { return parser_.crc_errors(); }
  /// Outside packets, or in damaged ones.
  std::uint32_t noise_bytes() const { return parser_.noise_bytes(); }

  /// Bytes to read in front of the wanted ones in a read that repeats every tick: a reply does not
  /// name its request, so its length must. 0 after an answered request, since bytes keep their
  /// order. Otherwise different from the last two reads, whose replies may still arrive. Call for
  /// at most two reads a tick, so that a number repeats only after three ticks.
  std::uint8_t spare_bytes();

  /// Sends frame(), for frames without a reply.
  bool send(std::size_t size);

  /// Passes each status packet to `take` until it returns kDone or time is over.
  template <class Handler>
  bool request(std::size_t size, std::uint32_t timeout, Handler&& take) {
    if (unsettled_) settle();
    parser_.reset();
    unsettled_ = true;
    if (!send(size)) return false;
    for (;;) {
      const std::size_t count = bus_.poll(rx_, sizeof rx_, timeout);
      if (count == 0) break;
      if (digest(count, take)) {
        unsettled_ = false;
        spare_ = 0;
        missed_ = false;
        return true;
      }
    }
    ++counters_.timeouts;
    missed_ = true;
    return false;
  }

 private:
  /// Drops late bytes; whole packets count as strays.
  void settle();

  template <class Handler>
  bool digest(std::size_t count, const Handler& take) {
    bool done = false;
    for (std::size_t i = 0; i < count; ++i) {
      for (bool found = parser_.push(rx_[i]); found; found = parser_.next()) {
        const dxl::Packet& packet = parser_.packet();
        if (!packet.is_status()) continue;  // our own request, echoed on one wire
        const Take verdict = done ? Take::kStray : take(packet);
        if (verdict == Take::kStray) ++counters_.strays;
        if (!packet.is_fast_reply() && (packet.error & ~dxl::kAlert) != 0) ++counters_.errors;
        done = done || verdict == Take::kDone;
      }
    }
    return done;
  }

  hal::FrameBus& bus_;
  dxl::Parser parser_;
  BusCounters counters_;
  bool unsettled_ = true;
  std::uint8_t spare_ = 0;
  bool missed_ = false;  ///< the last request had no answer
  std::uint8_t tx_[hal::kMaxFrame];
  std::uint8_t rx_[hal::kMaxFrame];
};

/// One Sync Read's devices in reply order. A silent device may silence those behind it, so the
/// first device missed moves to the end.
template <int kCapacity>
class ReadChain {
 public:
  void add(std::uint8_t id, std::uint8_t slot) {
    id_[count_] = id;
    slot_[count_] = slot;
    ++count_;
  }
  int count() const { return count_; }
  const std::uint8_t* ids() const { return id_; }
  void set_id(std::uint8_t slot, std::uint8_t id) {
    for (int i = 0; i < count_; ++i) id_[i] = slot_[i] == slot ? id : id_[i];
  }

  void begin() { next_ = 0, missed_ = -1; }
  /// The slot of this reply; -1: no device due has this id.
  int match(std::uint8_t id) {
    for (int i = next_; i < count_; ++i) {
      if (id_[i] != id) continue;
      if (i > next_) note_missed();
      next_ = i + 1;
      return slot_[i];
    }
    return -1;
  }
  bool ended() const { return next_ == count_; }
  /// Call after the read. True if all answered.
  bool complete() {
    if (next_ < count_) note_missed();
    if (missed_ < 0) return true;
    const std::uint8_t id = id_[missed_];
    const std::uint8_t slot = slot_[missed_];
    for (int i = missed_; i + 1 < count_; ++i) {
      id_[i] = id_[i + 1];
      slot_[i] = slot_[i + 1];
    }
    id_[count_ - 1] = id;
    slot_[count_ - 1] = slot;
    return false;
  }

 private:
  void note_missed() { missed_ = missed_ < 0 ? next_ : missed_; }
  std::uint8_t id_[kCapacity] = {};
  std::uint8_t slot_[kCapacity] = {};
  int count_ = 0;
  int next_ = 0;
  int missed_ = -1;
};

}  // namespace verp::app
