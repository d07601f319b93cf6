#include "host/apps/tool/walk_run.hpp"

#include <fmt/format.h>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"

namespace verp::tool {

void tell_falls(const WalkPlan& plan, cli::Progress& progress, const std::string& command,
                session::Hooks& hooks) {
  if (plan.get_ups == 0) return;
  const std::string who = command + ": " + (plan.name.empty() ? "" : plan.name + ": ");
  hooks.told = [&progress, who](const session::Happened& news) {
    progress.clear();
    cli::complain(fmt::format("{}{:.2f} s: {}", who, news.at_s, news.what));
  };
}

session::Hooks shown(const WalkPlan& plan, record::TraceWriter* trace, cli::Progress& progress,
                     const std::string& label, bool keep_series) {
  session::Hooks hooks;
  hooks.trace = trace;
  hooks.keep_series = keep_series;
  hooks.ticked = [&progress, label, walk_s = plan.walk_s](const session::Tick& tick) {
    progress.show(tick.gone_s / walk_s,
                  fmt::format("{}  {:.1f} of {:g} s", label, tick.gone_s, walk_s));
  };
  return hooks;
}

WalkResult walk(const WalkPlan& plan, record::TraceWriter* trace, cli::Progress& progress,
                const std::string& label, bool keep_series, const sim::WorldOptions& world) {
  return session::walk(plan, shown(plan, trace, progress, label, keep_series),
                       {.world = world, .interrupted = cli::interrupted});
}

}  // namespace verp::tool
