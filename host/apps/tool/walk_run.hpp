#pragma once
#include <string>

#include "host/apps/cli/progress.hpp"
#include "host/run/session/plan.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

using session::WalkPlan;
using session::WalkResult;

/// Shows the first robot's progress; reports falls and get-ups on stderr.
class RunOnScreen final : public session::Observer {
 public:
  /// `command` begins each line; empty: no lines. `label`: beside the bar; empty: the robot's name.
  RunOnScreen(cli::Progress& progress, std::string command, std::string label = {})
      : progress_(progress), command_(std::move(command)), label_(std::move(label)) {}

  void join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) override;
  void tick(std::size_t index, session::Robot& robot) override;

 private:
  cli::Progress& progress_;
  const std::string command_;
  std::string label_;
  double walk_s_ = 0;
};

/// Writes the first robot's ticks into a trace, which may be null.
class KeptTrace final : public session::Observer {
 public:
  explicit KeptTrace(record::TraceWriter* trace, bool keep_series = false)
      : trace_(trace), keep_series_(keep_series) {}
  void join(std::size_t index, const WalkPlan&, session::Hooks& hooks) override {
    if (index != 0) return;
    hooks.trace = trace_;
    hooks.keep_series = keep_series_;
  }

 private:
  record::TraceWriter* const trace_;
  const bool keep_series_;
};

/// `trace` may be null.
WalkResult walk(const WalkPlan& plan, record::TraceWriter* trace, cli::Progress& progress,
                const std::string& label, const sim::WorldOptions& world = {});

}  // namespace verp::tool
