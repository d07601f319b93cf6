#pragma once
#include <cstdint>

#include "firmware/app/bus_counters.hpp"
#include "hal/contract/can_bus.hpp"

namespace verp::app {

/// Counts refused frames, and lets time pass while the bus refuses them.
class CanMaster {
 public:
  explicit CanMaster(hal::CanBus& bus) : bus_(bus) {}

  bool send(const CanFrame& frame);
  /// The next frame of another node; false once `timeout_us` have passed since the last frame began
  /// on the wire or was refused.
  bool receive(CanFrame& frame, std::uint32_t timeout_us);
  /// The same until `end_us` of bus time.
  bool receive_until(CanFrame& frame, std::uint64_t end_us);
  bool take_waiting(CanFrame& frame) { return bus_.poll(frame, 0); }

  std::uint64_t now_us() { return bus_.now_us(); }
  hal::CanErrors errors() const { return bus_.errors(); }

  BusCounters counters;

 private:
  static constexpr int kMostPolls = 1000;  ///< polls that may pass no time

  // The bus counts timeouts from its last accepted frame, possibly long ago. A poll that ends early
  // reveals that.
  bool receive_until(CanFrame& frame, std::uint64_t end_us, std::uint64_t wait_us);

  hal::CanBus& bus_;
  bool accepted_ = true;
  bool accepted_before_ = true;  ///< a frame was accepted since begin_us_
  std::uint64_t begin_us_ = 0;
  std::uint64_t refused_us_ = 0;
};

}  // namespace verp::app
