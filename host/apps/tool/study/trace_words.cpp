#include "host/apps/tool/study/trace_words.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::tool {

record::Trace load_trace(const TraceWords& words) {
  record::Trace trace = record::read_trace(
      words.file, words.recover ? record::Read::kRecover : record::Read::kStrict);
  if (!trace.warning.empty()) cli::complain(trace.warning);
  return trace;
}

void refuse_same_file(const TraceWords& words) {
  std::error_code error;
  if (words.output.empty() || !std::filesystem::equivalent(words.file, words.output, error)) {
    return;
  }
  throw cli::ToolError(cli::kBadInput,
                       words.output + ": that is the trace itself; name another file with -o");
}

record::mcap::Compression compression_of(const TraceWords& words) {
  return words.compress ? record::mcap::Compression::kZstd : record::mcap::Compression::kNone;
}

void tell_of_other_decisions(const record::Trace& trace, const std::optional<std::uint32_t>& tick) {
  if (!tick) return;
  cli::complain(
      fmt::format("{}: from tick {} on this program decides otherwise than the one that "
                  "recorded it: goals and phases are left empty; `verp replay` names why",
                  trace.file.string(), *tick));
}

}  // namespace verp::tool
