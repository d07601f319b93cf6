#pragma once
#include <cstdint>
#include <ctime>

#include "hal/contract/tick_source.hpp"

namespace verp::link {

inline timespec to_timespec(std::uint64_t time_ns) {
  return {static_cast<std::time_t>(time_ns / 1'000'000'000),
          static_cast<long>(time_ns % 1'000'000'000)};
}

inline std::uint64_t monotonic_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000 +
         static_cast<std::uint64_t>(now.tv_nsec);
}

/// A replaced clock (tests/support/quick_clock.cpp) may wake a few microseconds early: hence the
/// loop.
inline void sleep_until_ns(std::uint64_t time_ns) {
  const timespec until = to_timespec(time_ns);
  do {
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  } while (monotonic_ns() < time_ns);
}

/// The PC's TickSource. wait() returns usually well under a millisecond late, under load by
/// milliseconds. SCHED_FIFO helps.
class SystemClock {
 public:
  bool start(std::uint32_t period_us) {
    if (period_us == 0) return false;
    period_ns_ = std::uint64_t{period_us} * 1000;
    next_ns_ = monotonic_ns() + period_ns_;
    return true;
  }

  std::uint32_t wait() {
    if (period_ns_ == 0) return 0;
    sleep_until_ns(next_ns_);
    const std::uint64_t begun = 1 + (monotonic_ns() - next_ns_) / period_ns_;
    next_ns_ += begun * period_ns_;
    return static_cast<std::uint32_t>(begun);
  }

  std::uint64_t now_us() const { return (monotonic_ns() - made_ns_) / 1000; }

 private:
  std::uint64_t made_ns_ = monotonic_ns();
  std::uint64_t period_ns_ = 0;
  std::uint64_t next_ns_ = 0;  ///< start of the next tick
};

static_assert(hal::TickSource<SystemClock>);

}  // namespace verp::link
