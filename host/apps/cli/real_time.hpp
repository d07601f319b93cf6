#pragma once
#include <string>

namespace verp::cli {

/// Real-time resources that the system grants to a control loop.
struct RealTime {
  bool fifo = false;    ///< this thread has real-time priority (SCHED_FIFO)
  bool locked = false;  ///< its memory is never paged out
  std::string advice;   ///< what is missing and the remedy, in one line; empty: nothing
};

/// Above the desktop's audio threads, below the kernel's interrupt threads (50).
inline constexpr int kLoopPriority = 40;

/// Requests both for the calling thread.
RealTime become_real_time();
/// Gives up the priority: a loop that cannot keep up must not block other programs.
void leave_real_time();

}  // namespace verp::cli
