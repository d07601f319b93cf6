#include "host/apps/tool/walk_ending.hpp"

#include <fmt/format.h>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::tool {
namespace {

/// Why the run failed; empty: it did not. `trace` belongs to the first walk.
std::string reason(const WalkResult& result, const Sweep& swept, const std::string& trace) {
  if (!result.good()) {
    return (result.failure.empty() ? "interrupted" : result.failure) +
           (trace.empty() ? "" : fmt::format("; `verp trace export {}` shows the run", trace));
  }
  if (!swept.failure.empty())
    return swept.failure + "; walk it with --step and --record to see why";
  return swept.interrupted ? "interrupted in the sweep; rows up to there are kept" : "";
}

int ending(const std::string& command, const std::string& reason, const WalkFiles& files) {
  for (const std::string& line : files.lost()) cli::complain(line);
  if (!reason.empty()) cli::complain(command + ": " + reason);
  return reason.empty() && files.lost().empty() ? cli::kGood : cli::kRunFailed;
}

}  // namespace

int finish_walk(const WalkPlan& plan, const WalkOptions& options, const scenario::Orders& orders,
                WalkFiles& files, const WalkResult& result, const Sweep& swept,
                const cli::Json& more, const std::string& more_text) {
  files.finish(result, to_report(plan, options, orders, result, swept), &plan.entity);
  if (options.json) {
    cli::Json json = to_json(plan, options, result, swept);
    json.update(more);
    files.add_to(json);
    cli::print_json(json);
  } else {
    cli::answer(to_text(plan, options, result, swept) + more_text + files.text());
  }
  return ending(options.command, reason(result, swept, files.trace_path().string()), files);
}

}  // namespace verp::tool
