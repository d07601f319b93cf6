#include "host/apps/tool/walk_team.hpp"

#include <fmt/format.h>

#include <cctype>
#include <memory>
#include <utility>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/real_time.hpp"
#include "host/apps/tool/bit_rate.hpp"
#include "host/apps/tool/walk_outside.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/os/link/link_error.hpp"
#include "host/run/session/remote_controller.hpp"

namespace verp::tool {
namespace {

/// A path beside the first robot's trace.
std::string file_of(const std::filesystem::path& first, const std::string& robot) {
  std::string name = robot;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  }
  const std::string file = first.stem().string() + "." + name + first.extension().string();
  return (first.parent_path() / file).string();
}

class Drivers {
 public:
  Drivers(const scenario::Scenario& scenario, session::Session& session, cli::Progress& progress)
      : scenario_(scenario), session_(session), progress_(progress) {}

  std::unique_ptr<session::Controller> make(session::Robot& robot) {
    const std::string name = robot.name();
    if (robot.plan().link.empty()) return session::make_controller(robot);
    try {
      return serve(robot, name);
    } catch (const link::LinkError& error) {
      throw link::LinkError(error.kind(), fmt::format("robot {}: {}", name, error.what()));
    } catch (const link::EndpointError& error) {
      throw link::EndpointError(fmt::format("robot {}: {}", name, error.what()));
    }
  }

 private:
  std::unique_ptr<session::Controller> serve(session::Robot& robot, const std::string& name) {
    const auto say = [this, name](const std::string& line) {
      progress_.clear();
      cli::complain(fmt::format("verp walk: {}: {}", name, line));
    };
    return session::make_served(
        robot, {.link = robot.plan().link,
                .pace = session::Pace::kLockstep,
                .patience_s = scenario_.patience_s,
                .ends_with_controller = true,
                .told = say,
                .check =
                    [&params = robot.plan().params](const link::CanInterface& interface) {
                      check_bit_rate("verp walk", interface, params);
                    },
                .gave_up =
                    [this, &robot, say](const std::string& why) {
                      say(why);
                      lose(robot);
                    }});
  }

  /// Ends the run if a lost controller must end it.
  void lose(const session::Robot& lost) {
    if (scenario_.if_lost_go_on) return;
    for (std::size_t i = 0; i < session_.size(); ++i) {
      if (&session_.robot(i) == &lost) continue;
      session_.robot(i).fail(fmt::format(
          "stopped, because {} lost its controller; --if-lost-go-on walks on", lost.name()));
    }
  }

  const scenario::Scenario& scenario_;
  session::Session& session_;
  cli::Progress& progress_;
};

}  // namespace

RunFiles::RunFiles(const WalkOptions& options, const Walk& walk, LiveStream& live) {
  const auto& plans = walk.run.plans;
  const bool one = plans.size() == 1;
  for (const WalkPlan& plan : plans) {
    WalkOptions own = options;
    const bool ours = plan.link.empty();
    if (!files_.empty()) {
      const std::filesystem::path& beside = first().trace_path();
      if (beside.empty() && !options.live.on) return;
      own.report_folder.clear();
      // Only a local controller's orders are known; a controller elsewhere may record its own.
      own.record_file = ours && !beside.empty() ? file_of(beside, plan.name) : "";
    }
    const std::string name = plan.name.empty() ? plan.params.name : plan.name;
    const bool heard = ours || files_.empty();
    files_.emplace_back(own, plan, metadata_of(options, plan, walk.scenario),
                        heard ? live.robot(one ? "" : name) : nullptr);
  }
}

void RunFiles::join(std::size_t index, const WalkPlan&, session::Hooks& hooks) {
  if (index >= files_.size()) return;
  hooks.trace = files_[index].trace();
  hooks.keep_series = files_[index].wants_report();
}

void RunFiles::finish_others(const std::vector<WalkResult>& results) {
  for (std::size_t i = 1; i < files_.size(); ++i) files_[i].finish(results[i], {});
}

std::string RunFiles::name(std::size_t robot) const {
  return robot < files_.size() ? files_[robot].trace_path().string() : "";
}

std::vector<std::string> RunFiles::lost_of_others() const {
  std::vector<std::string> lost;
  for (std::size_t i = 1; i < files_.size(); ++i)
    lost.insert(lost.end(), files_[i].lost().begin(), files_[i].lost().end());
  return lost;
}

RealTimePace::RealTimePace(const Walk& walk)
    : period_us_(walk.run.plans.front().params.period_us) {}

void RealTimePace::begin(session::Session&) {
  cli::become_real_time();
  pacer_.start(period_us_);
  urgent_ = true;
}

void RealTimePace::tick(std::size_t index, session::Robot&) {
  constexpr std::uint64_t kMost_us = 1'000'000;
  if (index != 0) return;
  pacer_.next();
  if (deadlines().worst_late_us > kMost_us && std::exchange(urgent_, false)) cli::leave_real_time();
}

void RealTimePace::end(session::Session&) {
  if (std::exchange(urgent_, false)) cli::leave_real_time();
}

Walks walk_together(const Walk& walk, const std::vector<session::Observer*>& observers,
                    cli::Progress& progress) {
  session::Session session({.world = walk.run.world, .interrupted = cli::interrupted});
  Drivers drivers(walk.scenario, session, progress);
  const link::SystemClock clock;
  const std::uint64_t begun_us = clock.now_us();
  Walks walks;
  walks.results = session::run(session, walk.run.plans, observers,
                               [&](session::Robot& robot) { return drivers.make(robot); });
  walks.took_s = 1e-6 * static_cast<double>(clock.now_us() - begun_us);
  if (session.scenery() != nullptr) walks.objects = objects_of(*session.scenery());
  return walks;
}

std::string team_text(const Walk& walk, const Walks& walks, const RunFiles& files) {
  std::string out;
  const sim::WorldOptions& world = walk.run.world;
  if (world.scenery != nullptr)
    out = fmt::format("  {:<18}{}, {}\n", "world", world.scenery->name, world.scenery->file);
  for (const cli::Json& each : walks.objects) {
    const cli::Json& at = each["position_m"];
    out += fmt::format("  {:<18}at the end at {:.3f} {:.3f} {:.3f} m\n",
                       each["name"].get<std::string>(), at[0].get<double>(), at[1].get<double>(),
                       at[2].get<double>());
  }
  for (std::size_t i = 1; i < walks.results.size(); ++i) {
    const WalkPlan& plan = walk.run.plans[i];
    const WalkResult& result = walks.results[i];
    const std::string trace = files.name(i);
    out +=
        fmt::format("  {:<18}{}, {:.2f} m, {}{}{}\n", plan.name,
                    result.failure.empty() ? "walked" : result.failure, way_of(plan, result).norm(),
                    plan.link.empty() ? fmt::format("digest 0x{:016x}", result.digest)
                                      : "driven over " + driver_of(plan),
                    plan.board.empty() ? "" : " on " + plan.board,
                    trace.empty() || !plan.link.empty() ? "" : ", " + trace);
  }
  return out;
}

cli::Json team_json(const Walk& walk, const Walks& walks, const RunFiles& files) {
  cli::Json out = cli::Json::object();
  const sim::WorldOptions& world = walk.run.world;
  if (world.scenery != nullptr) out = {{"world", world.scenery->file}, {"objects", walks.objects}};
  for (std::size_t i = 1; i < walks.results.size(); ++i) {
    const WalkPlan& plan = walk.run.plans[i];
    const WalkResult& result = walks.results[i];
    cli::Json row = {{"name", plan.name},
                     {"model", plan.params.name},
                     {"seed", plan.twin.seed},
                     {"controller", driver_of(plan)},
                     {"failure", result.failure},
                     {"ticks", result.ticks},
                     {"fallen", result.metrics.fallen},
                     {"start_m", {plan.twin.start_m.x(), plan.twin.start_m.y()}},
                     {"end_m", {result.end_m.x(), result.end_m.y()}},
                     {"digest", digest_json(plan, result)}};
    if (!files.name(i).empty()) row["trace"] = files.name(i);
    out["others"].push_back(row);
  }
  return out;
}

std::vector<std::string> failures_of(const Walk& walk, const Walks& walks, const RunFiles& files) {
  std::vector<std::string> lines = files.lost_of_others();
  for (std::size_t i = 1; i < walks.results.size(); ++i) {
    const std::string& failure = walks.results[i].failure;
    if (!failure.empty())
      lines.push_back(fmt::format("verp walk: {}: {}", walk.run.plans[i].name, failure));
  }
  return lines;
}

}  // namespace verp::tool
