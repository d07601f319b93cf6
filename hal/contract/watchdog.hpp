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
///  - Without feeding, the reset comes between timeout_us and kWatchdogSlack * timeout_us: an
///    independent, inaccurate oscillator clocks it.
///  - caused_reset(): whether the watchdog caused the last reset; constant until the next one.
///  - No call blocks.
namespace verp::hal {

/// The LSI of an STM32F405 runs at 17 to 47 kHz (DS8626, LSI oscillator characteristics): a factor
/// of 2.8.
inline constexpr std::uint32_t kWatchdogSlack = 3;

template <class Dog>
concept Watchdog = requires(Dog& dog, const Dog& seen, std::uint32_t timeout_us) {
  { dog.start(timeout_us) } -> std::same_as<bool>;
  { dog.feed() } -> std::same_as<void>;
  { seen.caused_reset() } -> std::same_as<bool>;
};

}  // namespace verp::hal
