#pragma once
#include <concepts>
#include <cstdint>

/// Watchdog: resets the controller unless its loop proves, by feeding it, that it lives.
///
/// Promises of a backend:
///  - start(timeout_us): arms it; from now on nothing but a reset disarms it. False, and nothing
///    changes, if the hardware cannot wait that long, if timeout_us is 0 or if it is armed already.
///  - feed(): restarts the wait. Feed only after a completed tick, never from an interrupt: an
///    interrupt lives on when the loop is dead. Before start() it does nothing.
///  - Unfed, the reset comes no earlier than timeout_us and no later than kWatchdogSlack times
///    that: it is clocked apart from the processor, by an oscillator that may be far off.
///  - caused_reset(): whether the last reset was its own; the same answer until the next reset.
///  - No call blocks.
/// Implementations: hal/fake/fake_watchdog.hpp, the independent watchdogs of hal/chip. User: a
/// board's main loop.
namespace verp::hal {

/// An STM32F405's LSI runs at 17 to 47 kHz (DS8626, LSI oscillator characteristics): a factor
/// of 2.8.
inline constexpr std::uint32_t kWatchdogSlack = 3;

template <class Dog>
concept Watchdog = requires(Dog& dog, const Dog& seen, std::uint32_t timeout_us) {
  { dog.start(timeout_us) } -> std::same_as<bool>;
  { dog.feed() } -> std::same_as<void>;
  { seen.caused_reset() } -> std::same_as<bool>;
};

}  // namespace verp::hal
