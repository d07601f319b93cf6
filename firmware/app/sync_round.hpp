#pragma once
#include <cstdint>

#include "firmware/app/answer_watch.hpp"

namespace verp::app {

/// Which SYNC of a tick is sent next: 1 to n in turn, as a rule.
///
/// Nodes count SYNCs (CiA 301). One that comes twice, or from somebody else, takes all of them one
/// further, and each group answers the SYNC before its own from then on; one that nobody heard
/// leaves them behind. So where most of a group show it, the controller sends one SYNC fewer, or
/// one more with the same counter, and all are back at once. Single nodes are SyncRepair's.
///
/// One more comes once in a tick, which has time for no more, and is never SYNC 1: a tick begins
/// with that.
///
/// On a bus that is crowded answers come late, which looks the same. So this asks for a window that
/// was over by its time, and in which the bus was free for as long as a drive takes to answer.
class SyncRound {
 public:
  explicit SyncRound(std::uint8_t groups) : groups_(groups) {}

  /// A tick begins, with SYNC 1.
  void begin() { again_ = false; }
  /// The one after SYNC `window`; more than `groups`: the tick's are over. `quiet` as said above.
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
