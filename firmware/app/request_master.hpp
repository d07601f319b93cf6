#pragma once
#include <cstddef>
#include <cstdint>

#include "firmware/app/bus_counters.hpp"
#include "firmware/app/wire_time.hpp"
#include "hal/contract/frame_bus.hpp"

namespace verp::app {

enum class Take { kStray, kMore, kDone };

/// Requests and replies over a FrameBus, whatever their protocol. A lost reply costs at most its
/// timeout. A late reply is dropped before the next request; an even later one has a wrong length
/// if similar requests add spare_bytes(). On a line that echoes, our own packets count as strays.
///
/// Words are the protocol's:
///  - Parser: push(byte) and next() find packets; packet(), reset(), noise_bytes().
///  - answers(packet, request, size): the packet is a device's, not the echo of our own request.
///  - refuses(packet): it reports that the request failed.
///  - damaged(parser): packets whose check failed.
template <class Words>
class RequestMaster {
 public:
  using Packet = typename Words::Packet;

  explicit RequestMaster(hal::FrameBus& bus) : bus_(bus) {}

  std::uint8_t* frame() { return tx_; }  ///< build requests here
  static constexpr std::size_t capacity() { return sizeof tx_; }
  std::uint64_t now_us() { return bus_.now_us(); }
  const BusCounters& counters() const { return counters_; }
  std::uint32_t crc_errors() const { return Words::damaged(parser_); }
  /// Outside packets, or in damaged ones.
  std::uint32_t noise_bytes() const { return parser_.noise_bytes(); }

  /// Bytes to read in front of the wanted ones in a read that repeats every tick: a reply does not
  /// name its request, so its length must. 0 after an answered request, since bytes keep their
  /// order. Otherwise different from the last two reads, whose replies may still arrive. Call for
  /// at most two reads a tick, so that a number repeats only after three ticks.
  std::uint8_t spare_bytes();

  /// Sends frame(), for frames without a reply.
  bool send(std::size_t size);

  /// Passes each answer to `take` until it returns kDone or time is over.
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
        const Packet& packet = parser_.packet();
        const bool answer = Words::answers(packet, tx_, sent_);
        const Take verdict = answer && !done ? take(packet) : Take::kStray;
        if (verdict == Take::kStray) ++counters_.strays;
        if (answer && Words::refuses(packet)) ++counters_.errors;
        done = done || verdict == Take::kDone;
      }
    }
    return done;
  }

  hal::FrameBus& bus_;
  typename Words::Parser parser_;
  BusCounters counters_;
  bool unsettled_ = true;
  std::uint8_t spare_ = 0;
  bool missed_ = false;   ///< the last request had no answer
  std::size_t sent_ = 0;  ///< bytes of tx_
  std::uint8_t tx_[hal::kMaxFrame];
  std::uint8_t rx_[hal::kMaxFrame];
};

template <class Words>
std::uint8_t RequestMaster<Words>::spare_bytes() {
  if (missed_) spare_ = spare_ < kMostSpare ? static_cast<std::uint8_t>(spare_ + 1) : 0;
  missed_ = false;
  return spare_;
}

template <class Words>
bool RequestMaster<Words>::send(std::size_t size) {
  sent_ = size;
  if (size != 0 && bus_.send(tx_, size)) return true;
  ++counters_.refused;
  return false;
}

template <class Words>
void RequestMaster<Words>::settle() {
  constexpr int kMostPieces = 8;  // a flooded bus must not block
  const auto stray = [](const Packet&) { return Take::kStray; };
  for (int i = 0; i < kMostPieces; ++i) {
    const std::size_t count = bus_.poll(rx_, sizeof rx_, 0);
    if (count == 0) break;
    digest(count, stray);
  }
  unsettled_ = false;
}

}  // namespace verp::app
