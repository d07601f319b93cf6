#pragma once
#include <concepts>
#include <cstdint>

/// TickSource: the clock that paces the control loop where the bus does not.
///
/// A backend promises:
///  - start(period_us): the first tick begins now, tick k at start + k * period_us, without drift.
///    False, with nothing changed, if the clock cannot make the period exactly (0 is refused). A
///    second start begins anew.
///  - wait(): returns when a tick has begun that no earlier wait() returned; at once if one has.
///    Returns their number: n > 1 means the loop missed n - 1. After start() the first wait()
///    returns for tick 1; before start() it returns 0 at once.
///  - now_us(): microseconds since construction, never decreasing, by the same clock: when wait()
///    returns for tick k, now_us() >= start + k * period_us.
///  - wait() is never early; each backend states how late. No call allocates or throws.
namespace verp::hal {

template <class Source>
concept TickSource = requires(Source& source, const Source& seen, std::uint32_t period_us) {
  { source.start(period_us) } -> std::same_as<bool>;
  { source.wait() } -> std::same_as<std::uint32_t>;
  { seen.now_us() } -> std::same_as<std::uint64_t>;
};

}  // namespace verp::hal
