#include "host/apps/tool/walk_run.hpp"

#include <fmt/format.h>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"

namespace verp::tool {

void RunOnScreen::join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) {
  if (index == 0) {
    walk_s_ = plan.walk_s;
    if (label_.empty()) label_ = plan.params.name;
  }
  if (plan.get_ups == 0 || command_.empty()) return;
  const std::string who = command_ + ": " + (plan.name.empty() ? "" : plan.name + ": ");
  hooks.told = [this, who](const session::RunEvent& news) {
    progress_.clear();
    cli::complain(fmt::format("{}{:.2f} s: {}", who, news.at_s, news.what));
  };
}

void RunOnScreen::tick(std::size_t index, session::Robot& robot) {
  if (index != 0) return;
  const double gone_s = robot.gone_s();
  progress_.show(gone_s / walk_s_, fmt::format("{}  {:.1f} of {:g} s", label_, gone_s, walk_s_));
}

WalkResult walk(const WalkPlan& plan, record::TraceWriter* trace, cli::Progress& progress,
                const std::string& label, const sim::WorldOptions& world) {
  session::Session session({.world = world, .interrupted = cli::interrupted});
  RunOnScreen screen(progress, "", label);
  KeptTrace kept(trace);
  return std::move(session::run(session, {plan}, {&screen, &kept}).front());
}

}  // namespace verp::tool
