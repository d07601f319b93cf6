#pragma once
#include <cstdint>

#include "hal/chip/stm32/interrupts.hpp"
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/cortex_m.hpp"
#include "hal/chip/stm32/registers/timer.hpp"
#include "hal/contract/tick_source.hpp"

/// TIM2 or TIM5 counts microseconds: the board's clock and TickSource. The processor sleeps while
/// it waits; a compare interrupt ends the wait, or SysTick after a millisecond at most if that
/// interrupt fails.
///
/// wait() is late by the interrupt's latency, well under 10 us; without compare interrupts (QEMU)
/// by up to a millisecond. The board's vectors call on_timer(); SysTick's handler may be empty.
/// Single owner: it must call now_us() at least every 71 minutes, and never from an interrupt.
namespace verp::hal::stm32 {

template <Io Access>
class TickTimer {
 public:
  explicit TickTimer(std::uint32_t timer_base, Access io = {}) : io_(io), base_(timer_base) {}

  /// `timer_hz` clocks the timer, `core_hz` SysTick. The timer's clock and interrupt are on. False:
  /// it cannot count microseconds exactly, or does not count.
  bool open(std::uint32_t timer_hz, std::uint32_t core_hz) {
    if (timer_hz < 1'000'000 || timer_hz % 1'000'000 != 0 || timer_hz / 1'000'000 > 0x10000) {
      return false;
    }
    io_.write32(base_ + timer::kCr1, 0);
    io_.write32(base_ + timer::kDier, 0);
    io_.write32(base_ + timer::kPsc, timer_hz / 1'000'000 - 1);
    io_.write32(base_ + timer::kArr, 0xFFFFFFFF);
    io_.write32(base_ + timer::kEgr, timer::kEgrUg);  // loads the prescaler
    io_.write32(base_ + timer::kSr, 0);
    io_.write32(base_ + timer::kCr1, timer::kCr1Cen);
    start_systick(core_hz);
    last_ = io_.read32(base_ + timer::kCnt);
    origin_us_ = last_;
    return counts();
  }

  // TickSource
  bool start(std::uint32_t period_us) {
    if (period_us == 0) return false;
    period_us_ = period_us;
    next_us_ = now_us() + period_us;
    return true;
  }
  std::uint32_t wait() {
    if (period_us_ == 0) return 0;
    while (now_us() < next_us_) doze_until(next_us_, [] { return false; });
    const std::uint64_t begun = 1 + (now_us() - next_us_) / period_us_;
    next_us_ += begun * period_us_;
    return static_cast<std::uint32_t>(begun);
  }
  std::uint64_t now_us() const {
    const std::uint32_t count = io_.read32(base_ + timer::kCnt);
    if (count < last_) high_ += std::uint64_t{1} << 32;
    last_ = count;
    return high_ + count - origin_us_;
  }
  /// For interrupts: low 32 bits of now_us().
  std::uint32_t stamp_us() const {
    return io_.read32(base_ + timer::kCnt) - static_cast<std::uint32_t>(origin_us_);
  }

  /// Sleeps until the next interrupt or deadline_us, unless `ready()`. Interrupts are masked while
  /// it asks, so no event slips in before the sleep.
  template <class Ready>
  void doze_until(std::uint64_t deadline_us, Ready&& ready) {
    const Masked<Access> masked(io_);
    io_.write32(base_ + timer::kCcr1, static_cast<std::uint32_t>(deadline_us + origin_us_));
    io_.write32(base_ + timer::kSr, timer::kSrAll & ~timer::kSrCc1if);
    io_.write32(base_ + timer::kDier, timer::kDierCc1ie);
    if (!ready() && now_us() < deadline_us) io_.wait_for_interrupt();
  }
  /// Disables the compare interrupt after it has woken the processor.
  void on_timer() {
    io_.write32(base_ + timer::kDier, 0);
    io_.write32(base_ + timer::kSr, timer::kSrAll & ~timer::kSrCc1if);
  }

 private:
  void start_systick(std::uint32_t core_hz) {
    io_.write32(cortex_m::kSystRvr, core_hz / 1000 - 1);
    io_.write32(cortex_m::kSystCvr, 0);
    io_.write32(cortex_m::kSystCsr,
                cortex_m::kSystCsrEnable | cortex_m::kSystCsrTickint | cortex_m::kSystCsrCore);
  }
  // A microsecond is at most 216 cycles, a poll at least 4.
  bool counts() const {
    for (int poll = 0; poll < 1000; ++poll) {
      if (io_.read32(base_ + timer::kCnt) != last_) return true;
    }
    return false;
  }

  [[no_unique_address]] mutable Access io_;
  std::uint32_t base_;
  mutable std::uint32_t last_ = 0;
  mutable std::uint64_t high_ = 0;
  std::uint64_t origin_us_ = 0;
  std::uint64_t next_us_ = 0;
  std::uint32_t period_us_ = 0;
};

}  // namespace verp::hal::stm32
