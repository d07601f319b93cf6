#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/bus_counters.hpp"
#include "firmware/app/schedule.hpp"
#include "hal/contract/frame_bus.hpp"

/// Requests and replies over a FrameBus. A lost reply costs its timeout, never more. What came too
/// late for its own request and before the next is dropped; what comes later still is known by its
/// length, if requests that are alike ask for spare_bytes() too.
namespace verp::app {

/// What a reply handler says about a packet.
enum class Take { kStray, kMore, kDone };

template <hal::FrameBus Bus>
class BusMaster {
 public:
  explicit BusMaster(Bus& bus) : bus_(bus) {}

  std::uint8_t* frame() { return tx_; }  ///< build the next request here
  static constexpr std::size_t capacity() { return sizeof tx_; }
  std::uint64_t now_us() { return bus_.now_us(); }
  const BusCounters& counters() const { return counters_; }
  std::uint32_t crc_errors() const { return parser_.crc_errors(); }
  /// Bytes that belonged to no packet, those of damaged packets included.
  std::uint32_t noise_bytes() const { return parser_.noise_bytes(); }

  /// A reply does not say which request it answers. To be asked for in front of what is wanted, in
  /// a read that is alike in every tick: none after an answered request, as bytes come in the order
  /// they were sent in; after an unanswered one another number than in the last two reads, so that
  /// their late replies have other lengths. To be called for two reads a tick at most: then it
  /// takes three ticks for a number to come again.
  std::uint8_t spare_bytes() {
    if (missed_) spare_ = spare_ < kMostSpare ? static_cast<std::uint8_t>(spare_ + 1) : 0;
    missed_ = false;
    return spare_;
  }

  /// Sends `size` bytes of frame(); for frames nobody answers.
  bool send(std::size_t size) {
    if (size != 0 && bus_.send(tx_, size)) return true;
    ++counters_.refused;
    return false;
  }

  /// Sends a request and hands each status packet to `take` until it says kDone or the time is
  /// over.
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
  /// Drops what an unanswered request may still have brought; whole packets count as strays.
  void settle() {
    constexpr int kMostPieces = 8;  // a bus that babbles must not hold the loop
    const auto stray = [](const dxl::Packet&) { return Take::kStray; };
    for (int i = 0; i < kMostPieces; ++i) {
      const std::size_t count = bus_.poll(rx_, sizeof rx_, 0);
      if (count == 0) break;
      digest(count, stray);
    }
    unsettled_ = false;
  }

  template <class Handler>
  bool digest(std::size_t count, const Handler& take) {
    bool done = false;
    for (std::size_t i = 0; i < count; ++i) {
      for (bool found = parser_.push(rx_[i]); found; found = parser_.next()) {
        const dxl::Packet& packet = parser_.packet();
        if (!packet.is_status()) continue;  // our own request, heard on a one-wire bus
        const Take verdict = done ? Take::kStray : take(packet);
        if (verdict == Take::kStray) ++counters_.strays;
        if (!packet.is_fast_reply() && (packet.error & ~dxl::kAlert) != 0) ++counters_.errors;
        done = done || verdict == Take::kDone;
      }
    }
    return done;
  }

  Bus& bus_;
  dxl::Parser parser_;
  BusCounters counters_;
  bool unsettled_ = true;
  std::uint8_t spare_ = 0;
  bool missed_ = false;  ///< the last request went unanswered
  std::uint8_t tx_[hal::kMaxFrame];
  std::uint8_t rx_[hal::kMaxFrame];
};

/// The devices of one Sync Read, in the order in which they answer. Replies follow each other: when
/// a device is silent, those behind it may be silent too, so the first that was missed goes to the
/// end of the queue.
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
  /// The slot whose reply this is; -1 if it is not that of a device still to come.
  int match(std::uint8_t id) {
    for (int i = next_; i < count_; ++i) {
      if (id_[i] != id) continue;
      if (i > next_) note_missed();
      next_ = i + 1;
      return slot_[i];
    }
    return -1;
  }
  /// True when nobody is left to answer.
  bool ended() const { return next_ == count_; }
  /// After the read: true if all answered; else the first that was missed goes last.
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
