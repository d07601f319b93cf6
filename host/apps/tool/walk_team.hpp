#pragma once
#include <deque>
#include <string>
#include <vector>

#include "firmware/app/pacer.hpp"
#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/os/link/system_clock.hpp"

/// The robots of one `verp walk`: the run itself, what each leaves, and what is said of those
/// beside the first.
namespace verp::tool {

/// A trace for each robot that this program drives, the first one's where the command line has it
/// and the others' beside it; and the first one's report.
class RunFiles final : public session::Observer {
 public:
  /// Throws as WalkFiles does.
  RunFiles(const WalkOptions& options, const Walk& walk, LiveStream& live);

  void join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) override;

  WalkFiles& first() { return files_.front(); }
  /// Ends the traces of all but the first.
  void finish_others(const std::vector<WalkResult>& results);
  /// Name of a robot's trace; empty: there is none.
  std::string name(std::size_t robot) const;
  /// What was wanted of all but the first and is not there.
  std::vector<std::string> lost_of_others() const;

 private:
  std::deque<WalkFiles> files_;
};

/// A run that goes no faster than the clock, before all that is not urgent where the system allows
/// it, as `verp run` has it. One that falls a second behind gives that up, so that others run too.
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
  std::vector<WalkResult> results;  ///< of each plan
  double took_s = 0;                ///< by the clock, waiting included
  cli::Json objects =
      cli::Json::array();  ///< of the world that can be pushed or move, where they ended
};

/// Runs them all. A robot whose plan names a link is driven from there, in lockstep: the world
/// waits until its controller has come, and in every tick until it has answered. One that loses its
/// controller ends the run of all, or by Scenario::if_lost_go_on its own.
Walks walk_together(const Walk& walk, const std::vector<session::Observer*>& observers,
                    cli::Progress& progress);

/// What there is to say of the world and of the robots beside the first.
std::string team_text(const Walk& walk, const Walks& walks, const RunFiles& files);
cli::Json team_json(const Walk& walk, const Walks& walks, const RunFiles& files);
/// A line for each robot beside the first whose walk is no good.
std::vector<std::string> failures_of(const Walk& walk, const Walks& walks, const RunFiles& files);

}  // namespace verp::tool
