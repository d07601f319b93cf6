#pragma once
#include <cstdint>

#include "hal/chip/stm32/clock_gate.hpp"
#include "hal/chip/stm32/gpio.hpp"
#include "hal/chip/stm32/interrupts.hpp"
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/rcc.hpp"
#include "hal/chip/stm32/registers/timer.hpp"

/// A passive buzzer: TIM3's interrupt toggles the pin. A tone stops itself and its interrupts, even
/// if a flag does not clear.
namespace verp::hal::stm32 {

template <Io Access>
class Buzzer {
 public:
  explicit Buzzer(Pin pin, Access io = {}) : io_(io), gpio_(io), pin_(pin) {}

  /// Call once. `timer_hz` is TIM3's clock; TIM3's vector calls on_interrupt().
  void open(std::uint32_t timer_hz) {
    if (!pin_.exists()) return;
    gpio_.output(pin_, false);
    enable_clock(io_, rcc::kApb1enr, rcc::kApb1Tim3);
    io_.write32(at(timer::kPsc), timer_hz / kCount_hz - 1);
  }

  /// `hz`: 20 to 20000; replaces the current tone. 0 ms: silence.
  void sound(std::uint32_t hz, std::uint32_t duration_ms) {
    if (!pin_.exists() || hz < kLeast_hz || hz > kMost_hz) return;
    const Masked<Access> masked(io_);
    end();
    left_ = 2 * hz * duration_ms / 1000;
    if (left_ == 0) return;
    io_.write32(at(timer::kArr), kCount_hz / (2 * hz) - 1);
    io_.write32(at(timer::kEgr), timer::kEgrUg);  // loads prescaler and reload
    io_.write32(at(timer::kSr), 0);
    io_.write32(at(timer::kDier), timer::kDierUie);
    io_.write32(at(timer::kCr1), timer::kCr1Cen);
  }

  void on_interrupt() {
    io_.write32(at(timer::kSr), timer::kSrAll & ~timer::kSrUif);
    if (left_ <= 1) return end();
    --left_;
    high_ = !high_;
    gpio_.write(pin_, high_);
  }

 private:
  static constexpr std::uint32_t kCount_hz = 1'000'000, kLeast_hz = 20, kMost_hz = 20'000;

  static std::uint32_t at(std::uint32_t offset) { return base::kTim3 + offset; }
  // The pin rests low, so that a silent buzzer draws no current.
  void end() {
    io_.write32(at(timer::kDier), 0);
    io_.write32(at(timer::kCr1), 0);
    left_ = 0;
    high_ = false;
    gpio_.write(pin_, false);
  }

  [[no_unique_address]] Access io_;
  Gpio<Access> gpio_;
  Pin pin_;
  std::uint32_t left_ = 0;  ///< pin toggles left
  bool high_ = false;
};

}  // namespace verp::hal::stm32
