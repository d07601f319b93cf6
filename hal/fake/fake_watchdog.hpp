#pragma once
#include <cstdint>

#include "hal/contract/watchdog.hpp"

/// A Watchdog whose time passes by advance(); the test sets the oscillator's speed.
namespace verp::hal {

class FakeWatchdog {
 public:
  static constexpr std::uint32_t kMost_us = 30'000'000;

  /// The real timeout is `percent` of the requested one: 100 to 100 * kWatchdogSlack.
  explicit FakeWatchdog(std::uint32_t percent = 100) : percent_(percent) {}

  void advance(std::uint64_t time_us) {
    if (timeout_us_ == 0) return;
    unfed_us_ += time_us;
    if (unfed_us_ <= std::uint64_t{timeout_us_} * percent_ / 100) return;
    caused_reset_ = true;
    ++resets_;
    timeout_us_ = 0;
    unfed_us_ = 0;
  }
  void reset() {
    caused_reset_ = false;
    timeout_us_ = 0;
    unfed_us_ = 0;
  }
  std::uint32_t resets() const { return resets_; }

  bool start(std::uint32_t timeout_us) {
    if (timeout_us_ != 0 || timeout_us == 0 || timeout_us > kMost_us) return false;
    timeout_us_ = timeout_us;
    unfed_us_ = 0;
    return true;
  }
  void feed() { unfed_us_ = 0; }
  bool caused_reset() const { return caused_reset_; }

 private:
  std::uint32_t percent_;
  std::uint32_t timeout_us_ = 0;  ///< 0: not armed
  std::uint64_t unfed_us_ = 0;
  std::uint32_t resets_ = 0;
  bool caused_reset_ = false;
};

static_assert(Watchdog<FakeWatchdog>);

}  // namespace verp::hal
