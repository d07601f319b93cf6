#pragma once
#include <cstdint>

#include "firmware/app/pacer.hpp"
#include "firmware/app/register_image.hpp"
#include "firmware/app/signals.hpp"
#include "hal/contract/watchdog.hpp"

/// Faults before the first tick that forbid torque until the next start, shown by register
/// start_fault, LED and buzzer. Nothing is retried: it takes a person and a reset.
namespace verp::app {

/// Opens the servo port and powers the servos, unless there is a fault. On a fault power stays off;
/// servos with a supply of their own may be stiff: they are ordered to release if the port works.
/// `Servos`: open() (false: the port failed), power(bool), release().
template <class Servos>
table::StartFault open_servos(Servos& servos, table::StartFault so_far) {
  using table::StartFault;
  servos.power(false);
  const bool open = servos.open();
  const StartFault fault = so_far != StartFault::kNone ? so_far
                           : open                      ? StartFault::kNone
                                                       : StartFault::kServoPort;
  if (fault != StartFault::kNone && open) servos.release();
  if (fault == StartFault::kNone) servos.power(true);
  return fault;
}

/// The watchdog is armed once for all loops of a start.
template <hal::Watchdog Dog>
class LoopGuard {
 public:
  /// `exists`: false on an emulator.
  LoopGuard(Dog& dog, bool exists) : dog_(dog), exists_(exists) {}

  /// Call last before the first tick: starts the pacing clock, then the watchdog. Do not tick after
  /// a fault.
  template <hal::TickSource Source>
  table::StartFault begin(Pacer<Source>& pacer, std::uint32_t period_us, std::uint32_t timeout_us) {
    using table::StartFault;
    if (!pacer.start(period_us)) return StartFault::kPeriod;
    armed_ = armed_ || dog_.start(timeout_us);
    return armed_ || !exists_ ? StartFault::kNone : StartFault::kWatchdog;
  }

 private:
  Dog& dog_;
  const bool exists_;
  bool armed_ = false;
};

/// Without a fault the LED blinks, half a second on, half off. Otherwise LED and buzzer repeat the
/// fault's number in flashes and beeps.
class LifeSign {
 public:
  struct Now {
    bool lit = false;
    bool changed = false;
    Tone tone;
  };
  static constexpr std::uint64_t kBlink_us = 500'000;
  static constexpr std::uint64_t kFlash_us = 200'000;  ///< on, then off for as long
  static constexpr std::uint64_t kPause_us = 2'000'000;
  static constexpr Tone kBeep = {400, 150};

  Now at(std::uint64_t now_us, table::StartFault fault) {
    const bool lit =
        fault == table::StartFault::kNone ? now_us / kBlink_us % 2 == 0 : counts(now_us, fault);
    const Now now{lit, lit != lit_, flashes(lit, fault) ? kBeep : Tone{}};
    lit_ = lit;
    return now;
  }

 private:
  static bool counts(std::uint64_t now_us, table::StartFault fault) {
    const std::uint64_t flashes_us = static_cast<std::uint64_t>(fault) * 2 * kFlash_us;
    const std::uint64_t at_us = now_us % (flashes_us + kPause_us);
    return at_us < flashes_us && at_us / kFlash_us % 2 == 0;
  }
  bool flashes(bool lit, table::StartFault fault) const {
    return lit && !lit_ && fault != table::StartFault::kNone;
  }

  bool lit_ = false;
};

}  // namespace verp::app
