#pragma once
#include <string>

namespace verp::cli {

/// What the system lets a control loop have.
struct RealTime {
  bool fifo = false;    ///< this thread runs before all that is not urgent (SCHED_FIFO)
  bool locked = false;  ///< no page of it is ever fetched from a disk
  std::string advice;   ///< one line of what is missing, and how to get it; empty: nothing
};

/// Above what desktops give to sound, below the kernel's own threads for interrupts (50).
inline constexpr int kLoopPriority = 40;

/// Asks for both, for the calling thread.
RealTime become_real_time();
/// Gives the priority back: who can't keep up must not keep all others from running as well.
void leave_real_time();

}  // namespace verp::cli
