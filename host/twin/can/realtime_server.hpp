#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/twin/can/virtual_can.hpp"

namespace verp::can {

/// Serves the bus by a clock of the world, for a master that keeps time by itself: any CANopen
/// tool. Time, and with it the nodes' boot, begins with the first frame. Frames take their time on
/// the simulated wire besides what the interface takes.
class RealtimeServer {
 public:
  struct Counters {
    std::uint64_t frames = 0;   ///< from the master
    std::uint32_t dropped = 0;  ///< of these, what came faster than the simulated wire is
    std::uint32_t late = 0;     ///< turns at which the twin was over kLate_us behind the clock
    std::uint64_t worst_late_us = 0;  ///< behind the clock at the end of a turn
    std::uint64_t skipped_us = 0;     ///< of the clock, in which the twin's time stood
  };
  static constexpr std::uint64_t kLate_us = 1000;  ///< a physics step
  /// A turn makes up for no more than this; what is beyond it never was, for the twin. So it hears
  /// and answers even where it is slower than the clock, and could only fall further behind.
  static constexpr std::uint64_t kMostBehind_us = 50'000;
  static constexpr std::uint64_t kKeepsUp_us = 1'000'000;  ///< without a skip

  /// Of the master, and when it came.
  struct Heard {
    CanFrame frame;
    std::uint64_t came_us = 0;
  };

  explicit RealtimeServer(VirtualCan& bus) : bus_(bus) {}

  /// All that came and waits, in one turn: time goes on to when each came; appends what the bus
  /// brings up to then to `answer`. It is `clock_us` by now, and frames may have waited for long:
  /// time goes on all the same. It does so once for all of them: where it costs this PC more than
  /// it is worth, whoever asks more often than there are turns would be answered later and later.
  void hear(std::span<const Heard> frames, std::uint64_t clock_us, std::vector<CanFrame>& answer);
  /// Time goes on to `clock_us`, without a frame; nothing before the first.
  void turn(std::uint64_t clock_us, std::vector<CanFrame>& answer);
  /// What the clock says at the end of a turn: how late is the twin?
  void finished(std::uint64_t clock_us);

  /// A master has spoken: time goes on.
  bool begun() const { return begun_; }
  /// Nothing was skipped for kKeepsUp_us at least once, or little in all: a short run may be held
  /// up as well.
  bool kept_up() const { return kept_up_ || counters_.skipped_us <= bus_.now_us() / 10; }
  const Counters& counters() const { return counters_; }

 private:
  /// What the bus's clock should say; no less than it does: frames may be older than a skip.
  std::uint64_t due_us(std::uint64_t clock_us) const;
  /// Skips what the twin is behind by more than kMostBehind_us.
  void skip(std::uint64_t clock_us);
  void go_on(std::uint64_t clock_us, std::vector<CanFrame>& answer);

  VirtualCan& bus_;
  Counters counters_;
  std::uint64_t offset_us_ = 0;         ///< clock minus bus time
  std::uint64_t in_step_since_us_ = 0;  ///< by the clock
  bool begun_ = false;
  bool kept_up_ = false;
};

}  // namespace verp::can
