#include "host/tool/walk_run.hpp"

#include <fmt/format.h>

#include "host/tool/interrupt.hpp"

namespace verp::tool {

session::Hooks shown(const WalkPlan& plan, record::TraceWriter* trace, Progress& progress,
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

WalkResult walk(const WalkPlan& plan, record::TraceWriter* trace, Progress& progress,
                const std::string& label, bool keep_series, const sim::WorldOptions& world) {
  return session::walk(plan, shown(plan, trace, progress, label, keep_series),
                       {.world = world, .interrupted = interrupted});
}

}  // namespace verp::tool
