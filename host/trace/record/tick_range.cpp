#include "host/trace/record/tick_range.hpp"

#include <fmt/format.h>

namespace verp::record {
namespace {

constexpr double kRounding_s = 1e-9;  // 0.07 is not exactly 7 times 0.01

}  // namespace

void TickRangeFinder::add(std::uint32_t tick) {
  const double now_s = time_s(tick);
  const std::size_t index = count_++;
  if (index == 0) front_ = tick;
  back_ = tick;
  const bool first = !range_ && (!from_s_ || now_s >= *from_s_ - kRounding_s);
  if (!first && !is_in()) return;
  ended_ = to_s_ && now_s > *to_s_ + kRounding_s;
  if (first) range_ = {index, index};
  if (!ended_) range_->last = index;
  is_empty_ = first ? ended_ : is_empty_;
}

TickRange TickRangeFinder::range() const {
  if (count_ == 0) throw TraceError(head_.file, "has no tick", "give the trace of a longer run");
  if (range_ && !is_empty_) return *range_;
  throw TraceError(
      head_.file,
      fmt::format("has no tick from {:g} s to {:g} s", from_s_.value_or(time_s(front_)),
                  to_s_.value_or(time_s(back_))),
      fmt::format("it begins at {:g} s and ends at {:g} s", time_s(front_), time_s(back_)));
}

TickRange ticks_between(const Trace& trace, std::optional<double> from_s,
                        std::optional<double> to_s) {
  TickRangeFinder finder(trace, from_s, to_s);
  for (const TickRecord& tick : trace.ticks) finder.add(tick.inputs.tick);
  return finder.range();
}

}  // namespace verp::record
