#pragma once
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace verp::sim {

/// Sensor latency: readings taken at t - latency become available at t.
template <class Reading>
class Delay {
 public:
  explicit Delay(double latency_s)
      : latency_us_(static_cast<std::uint64_t>(std::llround(1e6 * latency_s))) {}

  void put(std::uint64_t measured_us, Reading reading) {
    on_the_way_.emplace_back(measured_us + latency_us_, std::move(reading));
  }
  /// The oldest reading that has arrived.
  std::optional<Reading> take(std::uint64_t now_us) {
    if (on_the_way_.empty() || on_the_way_.front().first > now_us) return std::nullopt;
    std::optional<Reading> reading(std::move(on_the_way_.front().second));
    on_the_way_.pop_front();
    return reading;
  }

 private:
  std::uint64_t latency_us_;
  std::deque<std::pair<std::uint64_t, Reading>> on_the_way_;
};

}  // namespace verp::sim
