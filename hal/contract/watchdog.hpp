#pragma once
#include <concepts>
#include <cstdint>

/// Watchdog: resets the controller unless its loop feeds it.
///
/// A backend promises:
///  - start(timeout_us): arms it; only a reset disarms it. False, with nothing changed, if the
///    hardware cannot wait that long, timeout_us is 0, or it is armed already.
///  - feed(): restarts the timeout; does nothing before start(). Feed only after a completed tick,
///    never from an interrupt: interrupts still run when the loop is dead.
///  - Unfed, it resets between timeout_us and kWatchdogSlack * timeout_us: its oscillator is
///    independent and inaccurate.
///  - caused_reset(): whether it caused the last reset; constant until the next one.
///  - No call blocks.
namespace verp::hal {

/// An STM32F405's LSI runs at 17 to 47 kHz, a factor of 2.8 (DS8626, LSI characteristics).
inline constexpr std::uint32_t kWatchdogSlack = 3;

template <class Dog>
concept Watchdog = requires(Dog& dog, const Dog& seen, std::uint32_t timeout_us) {
  { dog.start(timeout_us) } -> std::same_as<bool>;
  { dog.feed() } -> std::same_as<void>;
  { seen.caused_reset() } -> std::same_as<bool>;
};

}  // namespace verp::hal
