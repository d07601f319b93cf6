#pragma once
#include <cstdint>

#include "firmware/app/bus_counters.hpp"
#include "hal/contract/can_bus.hpp"

namespace verp::app {

/// Counts refused frames, and lets time pass while the bus refuses them.
template <hal::CanBus Bus>
class CanMaster {
 public:
  explicit CanMaster(Bus& bus) : bus_(bus) {}

  bool send(const CanFrame& frame) {
    const std::uint64_t now_us = bus_.now_us();
    accepted_ = bus_.send(frame);
    accepted_before_ = accepted_before_ || accepted_;
    if (!accepted_) refused_us_ = now_us;
    if (!accepted_) ++counters.refused;
    return accepted_;
  }
  /// The next frame of another node; false once `timeout_us` have passed since the last frame began
  /// on the wire or was refused.
  bool receive(CanFrame& frame, std::uint32_t timeout_us) {
    if (accepted_) return bus_.poll(frame, timeout_us);
    return receive_until(frame, refused_us_ + timeout_us,
                         accepted_before_ ? timeout_us : refused_us_ + timeout_us - begin_us_);
  }
  /// The same until `end_us` of bus time.
  bool receive_until(CanFrame& frame, std::uint64_t end_us) {
    const std::uint64_t now_us = bus_.now_us();
    return now_us < end_us ? receive_until(frame, end_us, end_us - now_us) : take_waiting(frame);
  }
  bool take_waiting(CanFrame& frame) { return bus_.poll(frame, 0); }

  std::uint64_t now_us() { return bus_.now_us(); }
  hal::CanErrors errors() const { return bus_.errors(); }

  BusCounters counters;

 private:
  static constexpr int kMostPolls = 1000;  ///< polls that may pass no time

  // The bus counts timeouts from its last accepted frame, possibly long ago. A poll that ends early
  // reveals that.
  bool receive_until(CanFrame& frame, std::uint64_t end_us, std::uint64_t wait_us) {
    for (int polls = 0; polls < kMostPolls; ++polls) {
      if (bus_.poll(frame, static_cast<std::uint32_t>(wait_us))) return true;
      const std::uint64_t now_us = bus_.now_us();
      begin_us_ = now_us - wait_us;  // or earlier
      accepted_before_ = false;
      if (now_us >= end_us) return false;
      wait_us += end_us - now_us;
    }
    return false;
  }

  Bus& bus_;
  bool accepted_ = true;
  bool accepted_before_ = true;  ///< a frame was accepted since begin_us_
  std::uint64_t begin_us_ = 0;
  std::uint64_t refused_us_ = 0;
};

}  // namespace verp::app
