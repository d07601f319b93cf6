#pragma once
#include <filesystem>
#include <optional>

#include "host/trace/record/mcap_writer.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::record {

/// What became of a cut.
struct Cut {
  std::size_t ticks = 0;
  std::uint32_t first_tick = 0, last_tick = 0;
  double first_s = 0, last_s = 0;
  bool from_state = false;  ///< it begins with a State; else where the trace does
};

/// A part of a trace as a trace of its own, with every message of that time. A replay needs the
/// State before its first tick, so it begins after the last State that was kept before `from_s`:
/// somewhat earlier, at most kKeyframeTicks. None given: from the beginning, to the end. Throws
/// TraceError.
Cut cut_trace(const std::filesystem::path& file, std::optional<double> from_s,
              std::optional<double> to_s, const std::filesystem::path& output,
              mcap::Compression compression = mcap::Compression::kNone);

}  // namespace verp::record
