#pragma once
#include <cstdint>

#include "common/safety/machine.hpp"

namespace verp::app {

/// A tone for a person nearby; 0 ms: none.
struct Tone {
  std::uint32_t hz = 0;
  std::uint32_t duration_ms = 0;
};

/// Buzzer: high and short when ready; low and long when the boot check refused torque, and for each
/// new fault; once a second while the supply is low.
class Signals {
 public:
  static constexpr Tone kReady = {2000, 80};
  static constexpr Tone kRefused = {400, 1000};
  static constexpr Tone kFault = {500, 400};
  static constexpr Tone kLowSupply = {1000, 100};
  static constexpr std::uint64_t kRepeat_us = 1'000'000;

  static constexpr Tone at_start(bool sound) { return sound ? kReady : kRefused; }

  /// Call once a tick.
  Tone after_tick(std::uint64_t now_us, std::uint32_t faults) {
    constexpr std::uint32_t kStopping = 0xFFFF;  // upper half: notices
    const std::uint32_t risen = faults & ~before_ & kStopping;
    before_ = faults;
    if (risen != 0) {
      next_us_ = now_us + kRepeat_us;
      return kFault;
    }
    if ((faults & safety::kFaultVoltage) == 0 || now_us < next_us_) return {};
    next_us_ = now_us + kRepeat_us;
    return kLowSupply;
  }

 private:
  std::uint32_t before_ = 0;
  std::uint64_t next_us_ = 0;
};

}  // namespace verp::app
