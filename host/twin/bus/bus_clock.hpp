#pragma once
#include <cstdint>

namespace verp::bus {

/// A hal::TickSource on the time of a simulated bus, which has time_us() and wait_until().
template <class Line>
class BusClock {
 public:
  explicit BusClock(Line& line) : line_(line) {}
  bool start(std::uint32_t period_us) {
    period_us_ = period_us;
    next_us_ = line_.time_us() + period_us;
    return true;
  }
  std::uint32_t wait() {
    line_.wait_until(next_us_);
    const std::uint64_t begun = 1 + (line_.time_us() - next_us_) / period_us_;
    next_us_ += begun * period_us_;
    return static_cast<std::uint32_t>(begun);
  }
  std::uint64_t now_us() const { return line_.time_us(); }
  std::uint64_t due_us() const { return next_us_; }

 private:
  Line& line_;
  std::uint32_t period_us_ = 0;
  std::uint64_t next_us_ = 0;
};

}  // namespace verp::bus
