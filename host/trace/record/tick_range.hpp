#pragma once
#include <cstddef>
#include <optional>

#include "host/trace/record/trace.hpp"

namespace verp::record {

/// Indices in Trace::ticks, both included.
struct TickRange {
  std::size_t first = 0, last = 0;
};

/// Times on `verp trace export`'s clock: tick times period. nullopt: the start, or the end. Throws
/// TraceError without a tick.
TickRange ticks_between(const Trace& trace, std::optional<double> from_s,
                        std::optional<double> to_s);

}  // namespace verp::record
