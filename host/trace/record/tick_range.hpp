#pragma once
#include <cstddef>
#include <optional>

#include "host/trace/record/trace.hpp"

namespace verp::record {

/// Places in Trace::ticks, both in it.
struct TickRange {
  std::size_t first = 0, last = 0;
};

/// The ticks of a time, on the clock that `verp trace export` has: tick times period. None given:
/// from the trace's beginning, to its end. Throws TraceError when there is none.
TickRange ticks_between(const Trace& trace, std::optional<double> from_s,
                        std::optional<double> to_s);

}  // namespace verp::record
