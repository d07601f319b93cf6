#pragma once
#include <filesystem>
#include <string>

#include "host/trace/record/mcap_reader.hpp"
#include "host/trace/record/mcap_writer.hpp"

namespace verp::record {

struct Recovered {
  std::size_t ticks = 0, messages = 0, channels = 0;
  mcap::LeftOut left_out;
  std::string warning;  ///< empty: the trace is whole
};

/// Writes every whole message of every channel, and what describes the run, as a whole trace. Left
/// out are chunks whose content is damaged; a record whose length is damaged, or a truncation, ends
/// it. The warning says what and where. Throws TraceError.
Recovered recover_trace(const std::filesystem::path& file, const std::filesystem::path& output,
                        mcap::Compression compression = mcap::Compression::kNone);

}  // namespace verp::record
