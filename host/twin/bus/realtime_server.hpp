#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {

/// Serves the bus by a clock of the world, for a master that keeps time by itself: a controller
/// with its own timer, or any Dynamixel tool. Time begins with the first byte. Bytes cost their
/// time on the simulated wire besides what the link takes.
class RealtimeServer {
 public:
  struct Counters {
    std::uint64_t bytes = 0;  ///< from the master
    std::uint32_t lost = 0;   ///< requests that came while a servo was answering
    std::uint32_t late = 0;   ///< turns at which the twin was over kLate_us behind the clock
    std::uint64_t worst_late_us = 0;  ///< behind the clock at the end of a turn
    std::uint64_t skipped_us = 0;     ///< of the clock, in which the twin's time stood
  };
  static constexpr std::uint64_t kLate_us = 1000;  ///< a physics step
  /// A turn makes up for no more than this; what is beyond it never was, for the twin: see
  /// can::RealtimeServer.
  static constexpr std::uint64_t kMostBehind_us = 50'000;
  /// What a serial port's driver takes before it makes its program wait.
  static constexpr std::size_t kPort_bytes = 4096;

  explicit RealtimeServer(VirtualBus& bus) : bus_(bus) {}

  /// Time goes on to `clock_us`, and what was heard reaches the bus then; appends what the bus
  /// brings to `answer`.
  void turn(std::uint64_t clock_us, std::span<const std::uint8_t> heard,
            std::vector<std::uint8_t>& answer);
  /// How many bytes more the port takes now: a master that writes faster than the wire carries has
  /// to wait.
  std::size_t room() const;
  /// What the clock says at the end of a turn: how late is the twin?
  void finished(std::uint64_t clock_us);
  /// The plant, held until now, is let go: time is 0 then.
  void let_go(std::uint64_t clock_us);

  /// A master has spoken: time goes on.
  bool begun() const { return begun_; }
  Counters counters() const;

 private:
  void begin(std::uint64_t clock_us);

  VirtualBus& bus_;
  Counters counters_;
  std::uint64_t offset_us_ = 0;  ///< clock minus bus time
  bool begun_ = false;
};

}  // namespace verp::bus
