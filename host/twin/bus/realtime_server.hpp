#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {

/// Serves a controller with a timer, or any Dynamixel tool, on a real clock. Time starts with the
/// first byte. Simulated wire time adds to the link's.
class RealtimeServer {
 public:
  struct Counters {
    std::uint64_t bytes = 0;  ///< from the master
    std::uint32_t lost = 0;   ///< requests while a servo was answering
    std::uint32_t late = 0;   ///< turns over kLate_us behind the clock
    std::uint64_t worst_late_us = 0;
    std::uint64_t skipped_us = 0;  ///< clock time without simulation
  };
  static constexpr std::uint64_t kLate_us = 1000;  ///< a physics step
  /// A turn catches up at most this much and skips the rest (can::RealtimeServer).
  static constexpr std::uint64_t kMostBehind_us = 50'000;
  /// Bytes that a serial driver accepts before it blocks its program.
  static constexpr std::size_t kPort_bytes = 4096;

  explicit RealtimeServer(VirtualBus& bus) : bus_(bus) {}

  /// Advances to `clock_us`, then delivers `heard`; appends the bus's bytes to `answer`.
  void turn(std::uint64_t clock_us, std::span<const std::uint8_t> heard,
            std::vector<std::uint8_t>& answer);
  /// Bytes that the port accepts now; a master faster than the wire must wait.
  std::size_t room() const;
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
