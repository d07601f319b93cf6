#pragma once
#include <cstdint>

#include "hal/contract/tick_source.hpp"

/// A TickSource whose time passes only in wait() and advance().
namespace verp::hal {

class ManualClock {
 public:
  /// Time that the loop or a busy PC takes.
  void advance(std::uint64_t time_us) { now_us_ += time_us; }

  bool start(std::uint32_t period_us) {
    if (period_us == 0) return false;
    period_us_ = period_us;
    next_us_ = now_us_ + period_us;
    return true;
  }

  std::uint32_t wait() {
    if (period_us_ == 0) return 0;
    if (now_us_ < next_us_) now_us_ = next_us_;
    const std::uint64_t begun = 1 + (now_us_ - next_us_) / period_us_;
    next_us_ += begun * period_us_;
    return static_cast<std::uint32_t>(begun);
  }

  std::uint64_t now_us() const { return now_us_; }

 private:
  std::uint32_t period_us_ = 0;
  std::uint64_t now_us_ = 0;
  std::uint64_t next_us_ = 0;  ///< when the next tick begins
};

static_assert(TickSource<ManualClock>);

}  // namespace verp::hal
