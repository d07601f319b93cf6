#pragma once
#include <cstddef>
#include <optional>

#include "host/trace/record/trace.hpp"

namespace verp::record {

/// First and last index in Trace::ticks, both included.
struct TickRange {
  std::size_t first = 0, last = 0;
};

/// The ticks of a time interval on the clock of `verp trace export`: tick times period. nullopt:
/// from the start, or to the end. Throws TraceError if there is none.
TickRange ticks_between(const Trace& trace, std::optional<double> from_s,
                        std::optional<double> to_s);

}  // namespace verp::record
