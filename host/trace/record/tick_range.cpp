#include "host/trace/record/tick_range.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace verp::record {
namespace {

constexpr double kRounding_s = 1e-9;  // 0.07 is not exactly 7 times 0.01

}  // namespace

TickRange ticks_between(const Trace& trace, std::optional<double> from_s,
                        std::optional<double> to_s) {
  const std::vector<TickRecord>& ticks = trace.ticks;
  if (ticks.empty()) throw TraceError(trace.file, "has no tick", "give the trace of a longer run");
  const auto time_s = [&](const TickRecord& tick) { return tick.inputs.tick * trace.period_s(); };
  const auto first = std::find_if(ticks.begin(), ticks.end(), [&](const TickRecord& tick) {
    return !from_s || time_s(tick) >= *from_s - kRounding_s;
  });
  const auto end = std::find_if(first, ticks.end(), [&](const TickRecord& tick) {
    return to_s && time_s(tick) > *to_s + kRounding_s;
  });
  if (first == end) {
    throw TraceError(
        trace.file,
        fmt::format("has no tick from {:g} s to {:g} s", from_s.value_or(time_s(ticks.front())),
                    to_s.value_or(time_s(ticks.back()))),
        fmt::format("it begins at {:g} s and ends at {:g} s", time_s(ticks.front()),
                    time_s(ticks.back())));
  }
  return {static_cast<std::size_t>(first - ticks.begin()),
          static_cast<std::size_t>(end - ticks.begin()) - 1};
}

}  // namespace verp::record
