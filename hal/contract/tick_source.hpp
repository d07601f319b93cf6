#pragma once
#include <concepts>
#include <cstdint>

/// TickSource: the clock that paces the control loop where the bus doesn't do it.
///
/// Promises of a backend:
///  - start(period_us): the first tick begins now, tick k at start + k * period_us, without drift.
///    False, and nothing changes, if the clock cannot make that period exactly (0 always). Started
///    again, it begins anew.
///  - wait(): returns as soon as a tick has begun that no wait() has returned; at once if one has.
///    Returns how many: 1 is in time, n > 1 says that the loop missed n - 1 beginnings. After
///    start() the first wait() returns for tick 1. Before start() it returns 0 at once.
///  - now_us(): microseconds since the source was made; never decreasing, also before start(),
///    and the same clock that paces the ticks: when wait() returns for tick k, now_us() is at
///    least start + k * period_us.
///  - It never returns early; how late, is the backend's to say. No call allocates or throws.
/// Implementations: hal/fake/manual_clock.hpp, host/link/system_clock.hpp. User: a real-time loop,
/// which calls wait() and then App::tick(); firmware/app/pacer.hpp does it and keeps account.
namespace verp::hal {

template <class Source>
concept TickSource = requires(Source& source, const Source& seen, std::uint32_t period_us) {
  { source.start(period_us) } -> std::same_as<bool>;
  { source.wait() } -> std::same_as<std::uint32_t>;
  { seen.now_us() } -> std::same_as<std::uint64_t>;
};

}  // namespace verp::hal
