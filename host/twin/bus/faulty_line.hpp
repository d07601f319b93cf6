#pragma once
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "hal/contract/frame_bus.hpp"
#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {

/// Shares of bytes and of frames, both directions.
struct LineFaults {
  double lost = 0, doubled = 0, flipped = 0;  ///< of bytes
  double delayed = 0;                         ///< replies that come late from some byte on,
  std::uint32_t delay_us = 0;                 ///< by up to this
  std::uint32_t held_us = 0;                  ///< all replies, as by a slow adapter
  double bursts = 0;                          ///< noise in, before or after frames and replies
  bool cut = false;
};

struct LineDamage {
  std::uint32_t lost = 0, doubled = 0, flipped = 0, delayed = 0, bursts = 0;
  std::uint32_t cut_frames = 0;
  /// Requests without a whole answer after a lost or changed byte.
  std::uint32_t spoilt_reads = 0;
  std::uint32_t noise_heard = 0;
  std::uint32_t faults() const { return lost + doubled + flipped + delayed + bursts + cut_frames; }
};

/// A cable and an adapter that spoil what goes over them; in real time, at the pace of BusClock.
class FaultyLine final : public hal::FrameBus {
 public:
  FaultyLine(VirtualBus& bus, std::uint32_t seed) : bus_(bus), random_(seed) {
    bus.set_real_time(true);
  }

  LineFaults faults;
  const LineDamage& damage() const { return damage_; }

  bool send(const std::uint8_t* data, std::size_t size) override;
  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override;
  std::uint64_t now_us() override { return bus_.now_us(); }

  std::uint64_t time_us() const { return bus_.now_us(); }
  void wait_until(std::uint64_t time_us);

 private:
  struct Arrived {
    std::uint64_t due_us;
    std::uint8_t byte;
  };
  bool chance(double share) {
    return share > 0 && std::uniform_real_distribution<double>(0, 1)(random_) < share;
  }
  std::vector<std::uint8_t> spoilt(const std::vector<std::uint8_t>& bytes, bool inbound);
  void arrive(const std::uint8_t* data, std::size_t size);
  std::size_t fetch(std::uint8_t* buffer, std::size_t capacity);
  void note_spoilt();

  VirtualBus& bus_;
  std::minstd_rand random_;
  LineDamage damage_;
  std::deque<Arrived> inbox_;
  std::uint64_t sent_us_ = 0;      ///< when the last frame began, delivered or not
  std::uint64_t bus_sent_us_ = 0;  ///< when the last delivered frame began
  bool reading_ = false;
  bool spoilt_ = false;  ///< the last frame gets no whole answer
};

}  // namespace verp::bus
