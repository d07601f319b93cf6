#pragma once
#include <filesystem>
#include <string>

#include "host/trace/record/mcap_writer.hpp"

namespace verp::record {

struct Recovered {
  std::size_t ticks = 0, messages = 0, channels = 0;
  std::string warning;  ///< empty: the trace is whole
};

/// Writes every whole message of every channel before a truncation or damage, and what describes
/// the run, as a whole trace. Throws TraceError.
Recovered recover_trace(const std::filesystem::path& file, const std::filesystem::path& output,
                        mcap::Compression compression = mcap::Compression::kNone);

}  // namespace verp::record
