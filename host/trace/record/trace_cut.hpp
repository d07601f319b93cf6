#pragma once
#include <filesystem>
#include <optional>

#include "host/trace/record/mcap_writer.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::record {

struct Cut {
  std::size_t ticks = 0;
  std::uint32_t first_tick = 0, last_tick = 0;
  double first_s = 0, last_s = 0;
  bool from_state = false;  ///< true: starts from a State; false: at the trace's start
};

/// A part as a trace, with all its messages. Replay needs a State, so it starts after the last one
/// kept before `from_s`, at most kKeyframeTicks earlier. nullopt: the start, or the end. Throws
/// TraceError.
Cut cut_trace(const std::filesystem::path& file, std::optional<double> from_s,
              std::optional<double> to_s, const std::filesystem::path& output,
              mcap::Compression compression = mcap::Compression::kNone);

}  // namespace verp::record
