#pragma once
#include <string>

namespace verp::cli {

/// Resources that the system granted to a control loop.
struct RealTime {
  bool fifo = false;    ///< SCHED_FIFO
  bool locked = false;  ///< memory never paged out
  std::string advice;   ///< one line with the remedy; empty: nothing is missing
};

/// Between the desktop's audio threads and the kernel's interrupt threads (50).
inline constexpr int kLoopPriority = 40;

/// For the calling thread.
RealTime become_real_time();
/// A loop that cannot keep up must not block other programs.
void leave_real_time();

}  // namespace verp::cli
