#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/twin/can/virtual_can.hpp"

namespace verp::can {

/// Serves any CANopen tool on a real clock. Time and the nodes' boot start with the first frame.
/// Simulated wire time adds to the interface's.
class RealtimeServer {
 public:
  struct Counters {
    std::uint64_t frames = 0;   ///< from the master
    std::uint32_t dropped = 0;  ///< came faster than the simulated wire
    std::uint32_t late = 0;     ///< turns over kLate_us behind the clock
    std::uint64_t worst_late_us = 0;
    std::uint64_t skipped_us = 0;  ///< clock time without simulation
  };
  static constexpr std::uint64_t kLate_us = 1000;  ///< a physics step
  /// A turn catches up at most this much and skips the rest, so that a slow twin still answers.
  static constexpr std::uint64_t kMostBehind_us = 50'000;
  static constexpr std::uint64_t kKeepsUp_us = 1'000'000;  ///< time without a skip

  struct ReceivedFrame {
    CanFrame frame;
    std::uint64_t came_us = 0;
  };

  explicit RealtimeServer(VirtualCan& bus) : bus_(bus) {}

  /// Handles all waiting frames: advances to each arrival (at most kMostBehind_us / 2 before
  /// `clock_us`) and appends the bus's frames to `answer`. It skips once for all, or answers to a
  /// fast master would come later and later.
  void hear(std::span<const ReceivedFrame> frames, std::uint64_t clock_us,
            std::vector<CanFrame>& answer);
  /// Advances to `clock_us` without a frame; does nothing before the first frame.
  void turn(std::uint64_t clock_us, std::vector<CanFrame>& answer);
  void finished(std::uint64_t clock_us);

  bool begun() const { return begun_; }
  /// Nothing was skipped for kKeepsUp_us once, or little in all.
  bool kept_up() const { return kept_up_ || counters_.skipped_us <= bus_.now_us() / 10; }
  const Counters& counters() const { return counters_; }

 private:
  /// Never before the bus's present time, because frames may be older than a skip.
  std::uint64_t due_us(std::uint64_t clock_us) const;
  void skip(std::uint64_t clock_us);
  void go_on(std::uint64_t clock_us, std::vector<CanFrame>& answer);

  VirtualCan& bus_;
  Counters counters_;
  std::uint64_t offset_us_ = 0;         ///< clock minus bus time
  std::uint64_t in_step_since_us_ = 0;  ///< clock time
  bool begun_ = false;
  bool kept_up_ = false;
};

}  // namespace verp::can
