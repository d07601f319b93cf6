#pragma once
#include <cstdint>

#include "firmware/app/pacer.hpp"
#include "firmware/app/register_image.hpp"
#include "firmware/app/signals.hpp"
#include "hal/contract/watchdog.hpp"

/// What keeps a board from ever giving torque is found before the first tick, and told: by the
/// operator's register start_fault, by the LED, by the buzzer. Nothing is tried again and again: it
/// takes a person, and a reset.
namespace verp::app {

/// Opens the servos' port and gives the servos power, unless something is wrong by now: then they
/// stay without, and those that have their own, and that a run before this one left stiff, are told
/// to let go, if they can be told. `Servos`: open() false if the port can't, power(bool),
/// release().
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

/// What guards a loop once it ticks. A watchdog is armed once, for all loops of a start.
template <hal::Watchdog Dog>
class LoopGuard {
 public:
  /// `exists`: else an emulator, which has none.
  LoopGuard(Dog& dog, bool exists) : dog_(dog), exists_(exists) {}

  /// The last thing before the first tick: starts the clock that paces it, then the watchdog. A
  /// loop that the one or the other refuses must not tick.
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

/// What a board's LED and buzzer do while it lives: the LED blinks, half a second on and half a
/// second off; or it counts a start fault out, as many flashes as its number, and so does the
/// buzzer.
class LifeSign {
 public:
  struct Now {
    bool lit = false;
    bool changed = false;  ///< since the last call
    Tone tone;
  };
  static constexpr std::uint64_t kBlink_us = 500'000;
  static constexpr std::uint64_t kFlash_us = 200'000;  ///< and so long dark behind it
  static constexpr std::uint64_t kPause_us = 2'000'000;
  static constexpr Tone kBeep = {400, 150};

  /// As often as there is time.
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
