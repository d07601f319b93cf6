#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {

/// Serves the bus on a real clock to a master with its own timing: a controller with a timer, or
/// any Dynamixel tool. Time starts with the first byte. Bytes take simulated wire time in addition
/// to the link's time.
class RealtimeServer {
 public:
  struct Counters {
    std::uint64_t bytes = 0;          ///< from the master
    std::uint32_t lost = 0;           ///< requests that arrived while a servo was answering
    std::uint32_t late = 0;           ///< turns with the twin over kLate_us behind the clock
    std::uint64_t worst_late_us = 0;  ///< behind the clock at the end of a turn
    std::uint64_t skipped_us = 0;     ///< clock time for which the twin stood still
  };
  static constexpr std::uint64_t kLate_us = 1000;  ///< a physics step
  /// A turn catches up at most this much; the twin skips the rest (see can::RealtimeServer).
  static constexpr std::uint64_t kMostBehind_us = 50'000;
  /// Bytes that a serial driver accepts before it blocks its program.
  static constexpr std::size_t kPort_bytes = 4096;

  explicit RealtimeServer(VirtualBus& bus) : bus_(bus) {}

  /// Advances to `clock_us`, delivers `heard` to the bus then, and appends the bus's bytes to
  /// `answer`.
  void turn(std::uint64_t clock_us, std::span<const std::uint8_t> heard,
            std::vector<std::uint8_t>& answer);
  /// Bytes that the port accepts now; a master faster than the wire must wait.
  std::size_t room() const;
  /// Records how late the twin is at the end of a turn.
  void finished(std::uint64_t clock_us);
  void let_go(std::uint64_t clock_us);

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
