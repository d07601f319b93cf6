#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/bus/virtual_bus.hpp"

namespace verp::bus {

/// Serves the bus by a clock of the world, for a master that keeps time by itself: a controller
/// with its own timer, or any Dynamixel tool. Time begins with the first whole packet. Bytes cost
/// their time on the simulated wire besides what the link takes.
class RealtimeServer {
 public:
  struct Counters {
    std::uint64_t bytes = 0;  ///< from the master
    std::uint32_t late = 0;   ///< turns at which the twin was over kLate_us behind the clock
    std::uint64_t worst_late_us = 0;  ///< behind the clock at the end of a turn
  };
  static constexpr std::uint64_t kLate_us = 1000;  ///< a physics step

  explicit RealtimeServer(VirtualBus& bus) : bus_(bus) {}

  /// Time goes on to `clock_us`, and what was heard reaches the bus then; appends what the bus
  /// brings to `answer`.
  void turn(std::uint64_t clock_us, std::span<const std::uint8_t> heard,
            std::vector<std::uint8_t>& answer);
  /// What the clock says at the end of a turn: how late is the twin?
  void finished(std::uint64_t clock_us);

  /// A master has spoken: time goes on.
  bool begun() const { return begun_; }
  const Counters& counters() const { return counters_; }

 private:
  void begin(std::uint64_t clock_us);

  VirtualBus& bus_;
  dxl::Parser line_;  ///< until time begins
  Counters counters_;
  std::uint64_t offset_us_ = 0;  ///< clock minus bus time
  bool begun_ = false;
};

}  // namespace verp::bus
