#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/apps/tool/live_stream.hpp"
#include "host/trace/record/mcap_writer.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::tool {

struct TraceWords {
  std::string file, output;
  bool json = false, recover = false;
  bool states = false;               ///< export
  std::vector<std::string> signals;  ///< plot
  bool list = false;
  bool compress = false;           ///< cut, merge, recover
  std::vector<std::string> files;  ///< merge
  std::optional<double> from_s, to_s;
  LiveOptions live;  ///< play
  double rate = 1;   ///< play: times real time
};

/// `recover` accepts a damaged trace.
record::Trace load_trace(const TraceWords& words);
/// -o must not name the trace.
void refuse_same_file(const TraceWords& words);
/// Warns that goals and phases are unknown from `tick` on; empty: no warning.
void tell_of_other_decisions(const record::Trace& trace, const std::optional<std::uint32_t>& tick);

record::mcap::Compression compression_of(const TraceWords& words);

/// These return the exit status; throw ToolError and TraceError.
int export_csv(const TraceWords& words);
int plot_trace(const TraceWords& words);
int merge(const TraceWords& words);
int play(const TraceWords& words);

}  // namespace verp::tool
