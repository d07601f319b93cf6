#pragma once
#include <cstdint>

#include "firmware/app/contracts.hpp"
#include "hal/contract/tick_source.hpp"

namespace verp::app {

/// A tick's deadline is the start of the next period.
struct Deadlines {
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;         ///< ticks that ended late or were followed by skipped periods
  std::uint64_t skipped = 0;        ///< periods without a tick
  std::uint64_t worst_late_us = 0;  ///< longest delay of a tick's start
};

/// Paces a loop by a clock and counts missed deadlines:
///
///     pacer.start(period_us);
///     for (;;) app.tick(pacer.next());
///
/// Missed ticks carry kOverrun in their records.
template <hal::TickSource Source>
class Pacer {
 public:
  explicit Pacer(Source& clock) : clock_(clock) {}

  /// False: the clock cannot make that period. The first tick is due one period later.
  bool start(std::uint32_t period_us) {
    const bool started = clock_.start(period_us);
    period_us_ = period_us;
    due_us_ = clock_.now_us() + period_us;
    return started;
  }

  /// Call after a tick: waits for the next one.
  Beat next() {
    const bool late = clock_.now_us() > due_us_;
    const std::uint32_t begun = clock_.wait();
    if (deadlines_.ticks++ == 0) {
      due_us_ += std::uint64_t{begun} * period_us_;
      return {.periods = begun};
    }
    const std::uint64_t now_us = clock_.now_us();
    const std::uint64_t late_us = now_us > due_us_ ? now_us - due_us_ : 0;
    const Beat beat{.periods = begun, .overran = late || begun > 1};
    deadlines_.missed += beat.overran ? 1 : 0;
    deadlines_.skipped += begun > 1 ? begun - 1 : 0;
    if (late_us > deadlines_.worst_late_us) deadlines_.worst_late_us = late_us;
    due_us_ += std::uint64_t{begun} * period_us_;
    return beat;
  }

  const Deadlines& deadlines() const { return deadlines_; }

 private:
  Source& clock_;
  Deadlines deadlines_;
  std::uint32_t period_us_ = 0;
  std::uint64_t due_us_ = 0;
};

}  // namespace verp::app
