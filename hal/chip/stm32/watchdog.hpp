#pragma once
#include <cstdint>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/iwdg.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "hal/chip/stm32/registers/rcc.hpp"
#include "hal/chip/stm32/reset_cause.hpp"
#include "hal/contract/watchdog.hpp"

/// The independent watchdog. Its oscillator, LSI, runs at 17 to 47 kHz: the fastest chip never
/// fires early, the slowest keeps the contract's slack. Timeouts: 1.1 ms to 22 s.
namespace verp::hal::stm32 {

template <Io Access>
class IndependentWatchdog {
 public:
  explicit IndependentWatchdog(ResetCause cause, Access io = {}) : io_(io), cause_(cause) {}

  bool start(std::uint32_t timeout_us) {
    Setting setting;
    if (armed_ || !choose(timeout_us, setting) || !start_oscillator() || !set(setting))
      return false;
    setting_ = setting;
    io_.write32(at(iwdg::kKr), iwdg::kKeyReload);
    io_.write32(at(iwdg::kKr), iwdg::kKeyStart);
    armed_ = true;
    return true;
  }
  void feed() {
    if (armed_) io_.write32(at(iwdg::kKr), iwdg::kKeyReload);
  }
  bool caused_reset() const { return cause_ == ResetCause::kWatchdog; }

  /// Sets the longest timeout for an operation that stops the processor for seconds, such as a
  /// flash erase; relax() restores start()'s timeout. Does nothing before start().
  void stretch() {
    if (armed_ && set({iwdg::kPrMax, iwdg::kRlrMax})) feed();
  }
  void relax() {
    if (armed_ && set(setting_)) feed();
  }

 private:
  struct Setting {
    std::uint32_t prescaler = 0;
    std::uint32_t reload = 0;
  };
  // A new value takes 5 cycles of the slowest LSI, 300 us (RM0090 21.3.2); LSI starts within 40 us
  // (DS8626). At 168 MHz a poll takes at least 10 cycles.
  static constexpr std::uint32_t kPolls = 100'000;

  static std::uint32_t at(std::uint32_t offset) { return base::kIwdg + offset; }

  /// The finest setting that waits at least timeout_us on the fastest oscillator. The first count
  /// may be short, so one count guarantees no wait.
  static bool choose(std::uint32_t timeout_us, Setting& setting) {
    if (timeout_us == 0) return false;
    for (std::uint32_t prescaler = 0; prescaler <= iwdg::kPrMax; ++prescaler) {
      const std::uint64_t divider = std::uint64_t{4} << prescaler;
      const std::uint64_t count_length = divider * 1'000'000;
      const std::uint64_t reload =
          (std::uint64_t{timeout_us} * kLsiMax_hz + count_length - 1) / count_length;
      if (reload > iwdg::kRlrMax) continue;
      setting = {prescaler, static_cast<std::uint32_t>(reload)};
      const std::uint64_t latest_us = (reload + 1) * count_length / kLsiMin_hz;
      return latest_us <= std::uint64_t{kWatchdogSlack} * timeout_us;
    }
    return false;
  }
  bool start_oscillator() {
    modify32(io_, base::kRcc + rcc::kCsr, 0, rcc::kCsrLsion);
    for (std::uint32_t poll = 0; poll < kPolls; ++poll) {
      if ((io_.read32(base::kRcc + rcc::kCsr) & rcc::kCsrLsirdy) != 0) return true;
    }
    return false;
  }
  // The hardware ignores new values until it has applied the last one.
  bool settled() {
    for (std::uint32_t poll = 0; poll < kPolls; ++poll) {
      if ((io_.read32(at(iwdg::kSr)) & (iwdg::kSrPvu | iwdg::kSrRvu)) == 0) return true;
    }
    return false;
  }
  bool set(const Setting& setting) {
    if (!settled()) return false;
    io_.write32(at(iwdg::kKr), iwdg::kKeyUnlock);
    io_.write32(at(iwdg::kPr), setting.prescaler);
    io_.write32(at(iwdg::kRlr), setting.reload);
    return settled();
  }

  [[no_unique_address]] Access io_;
  ResetCause cause_;
  Setting setting_;
  bool armed_ = false;
};

}  // namespace verp::hal::stm32
