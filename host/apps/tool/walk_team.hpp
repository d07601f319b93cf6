#pragma once
#include <deque>
#include <string>
#include <vector>

#include "firmware/app/pacer.hpp"
#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::tool {

/// A trace for each local robot, the first at the given path and the others beside it; and the
/// first robot's report.
class RunFiles final : public session::Observer {
 public:
  /// Throws like WalkFiles.
  RunFiles(const WalkOptions& options, const Walk& walk, LiveStream& live);

  void join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) override;

  WalkFiles& first() { return files_.front(); }
  void finish_others(const std::vector<WalkResult>& results);
  /// Path of a robot's trace, or empty.
  std::string name(std::size_t robot) const;
  std::vector<std::string> lost_of_others() const;

 private:
  std::deque<WalkFiles> files_;
};

/// Paces a run by the clock, with real-time priority if possible. A second behind, it gives the
/// priority up: other programs need time.
class RealTimePace final : public session::Observer {
 public:
  explicit RealTimePace(const Walk& walk);

  void begin(session::Session& session) override;
  void tick(std::size_t index, session::Robot& robot) override;
  void end(session::Session& session) override;

  const app::Deadlines& deadlines() const { return pacer_.deadlines(); }

 private:
  link::SystemClock clock_;
  app::Pacer<link::SystemClock> pacer_{clock_};
  const std::uint32_t period_us_;
  bool urgent_ = false;
};

struct Walks {
  std::vector<WalkResult> results;         ///< of each plan
  double took_s = 0;                       ///< wall time, with waiting
  cli::Json objects = cli::Json::array();  ///< the world's movable objects, at the end
};

/// If a plan names a link, the controller there drives the robot in lockstep: the world waits for
/// it at every tick. A lost controller ends the run, or with Scenario::if_lost_go_on only its
/// robot's.
Walks walk_together(const Walk& walk, const std::vector<session::Observer*>& observers,
                    cli::Progress& progress);

/// Text on the world and on all robots but the first.
std::string team_text(const Walk& walk, const Walks& walks, const RunFiles& files);
cli::Json team_json(const Walk& walk, const Walks& walks, const RunFiles& files);
/// A line for each robot but the first whose walk failed.
std::vector<std::string> failures_of(const Walk& walk, const Walks& walks, const RunFiles& files);

}  // namespace verp::tool
