#include "host/apps/cli/real_time.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace verp::cli {
namespace {

bool lock_memory() {
  rlimit limit{};
  const bool unlimited =
      ::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
  // Under a memory limit the lock may succeed and a later allocation fail.
  if (!unlimited && ::geteuid() != 0) return false;
  return ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
}

}  // namespace

RealTime become_real_time() {
  RealTime got;
  const sched_param wanted{.sched_priority = kLoopPriority};
  got.fifo = ::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted) == 0;
  got.locked = lock_memory();
  if (got.fifo && got.locked) return got;
  got.advice = std::string("the system allows no ") +
               (got.fifo     ? "locked memory"
                : got.locked ? "real-time priority"
                             : "real-time priority and no locked memory") +
               ": other programs may make ticks late; two lines in "
               "/etc/security/limits.d/verp.conf, `@dialout - rtprio 40` and `@dialout - memlock "
               "unlimited`, then log in again";
  return got;
}

void leave_real_time() {
  const sched_param usual{};
  ::sched_setscheduler(0, SCHED_OTHER, &usual);
}

}  // namespace verp::cli
