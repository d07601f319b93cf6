#pragma once
#include <cstdint>

#include "firmware/app/answer_watch.hpp"

namespace verp::app {

/// The next SYNC of a tick, normally 1 to n.
///
/// Nodes count SYNCs (CiA 301). One that arrives twice, or from another node, advances all
/// counters, and each group then answers the SYNC before its own; one that nobody received leaves
/// all behind. When most of a group shows this, the controller sends one SYNC fewer, or one more
/// with the same counter. Single nodes are left to SyncRepair.
///
/// A tick has time for one extra SYNC, never SYNC 1.
///
/// Late answers look the same. So a correction requires a window that ended on time, with the bus
/// free for a drive's reaction time.
class SyncRound {
 public:
  explicit SyncRound(std::uint8_t groups) : groups_(groups) {}

  /// Begins a tick with SYNC 1.
  void begin() { again_ = false; }
  /// The SYNC after `window`; more than `groups`: the tick's are done. `quiet`: the window ended on
  /// time with the bus free.
  std::uint8_t after(std::uint8_t window, AnswerWatch& answers, bool quiet) {
    const auto next = static_cast<std::uint8_t>(window + 1);
    if (!quiet) return next;
    const std::uint8_t heard = answers.group_in(window);
    const bool lost = heard == 0 && answers.fell_silent(window);
    const bool behind = heard != 0 && heard % groups_ + 1 == window;
    if (lost || behind) {
      if (again_ || window == 1) return next;
      again_ = true;
      if (behind) answers.realign();
      return window;
    }
    if (heard < window) return next;
    answers.realign();
    return static_cast<std::uint8_t>(heard + 1);
  }

 private:
  std::uint8_t groups_;
  bool again_ = false;
};

}  // namespace verp::app
