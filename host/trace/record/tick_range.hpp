#pragma once
#include <cstddef>
#include <optional>

#include "host/trace/record/trace.hpp"

namespace verp::record {

/// Indices in Trace::ticks, both included.
struct TickRange {
  std::size_t first = 0, last = 0;
};

/// Finds the range of ticks that come one by one. Times as in ticks_between().
class TickRangeFinder {
 public:
  TickRangeFinder(const Trace& head, std::optional<double> from_s, std::optional<double> to_s)
      : head_(head), from_s_(from_s), to_s_(to_s) {}

  void add(std::uint32_t tick);
  bool has_begun() const { return range_.has_value(); }
  /// The last tick added is in the range.
  bool is_in() const { return has_begun() && !ended_; }
  /// Throws TraceError without a tick.
  TickRange range() const;

 private:
  double time_s(std::uint32_t tick) const { return tick * head_.period_s(); }

  const Trace& head_;
  const std::optional<double> from_s_, to_s_;
  std::size_t count_ = 0;
  std::uint32_t front_ = 0, back_ = 0;
  std::optional<TickRange> range_;
  bool ended_ = false, is_empty_ = false;
};

/// Times on `verp trace export`'s clock: tick times period. nullopt: the start, or the end. Throws
/// TraceError without a tick.
TickRange ticks_between(const Trace& trace, std::optional<double> from_s,
                        std::optional<double> to_s);

}  // namespace verp::record
