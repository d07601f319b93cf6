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
#include "host/apps/tool/walk_radio.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/os/link/link_error.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/run/session/served.hpp"

namespace verp::tool {
namespace {

/// A file of this one's, for the robot of that name.
std::string file_of(const std::filesystem::path& first, const std::string& robot) {
  std::string name = robot;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  }
  const std::string file = first.stem().string() + "." + name + first.extension().string();
  return (first.parent_path() / file).string();
}

/// Of a walk in real time: its ticks by the clock, and before all that is not urgent where the
/// system allows it, as `verp run` has them. Who is a second behind gives that up, so that others
/// run too.
class Pace {
 public:
  Pace(bool real_time, std::uint32_t period_us) : urgent_(real_time) {
    if (!real_time) return;
    cli::become_real_time();
    pacer_.start(period_us);
    real_time_ = true;
  }

  void next() {
    if (!real_time_) return;
    pacer_.next();
    constexpr std::uint64_t kMost_us = 1'000'000;
    if (urgent_ && deadlines().worst_late_us > kMost_us) end();
  }

  void end() {
    if (std::exchange(urgent_, false)) cli::leave_real_time();
  }

  const app::Deadlines& deadlines() const { return pacer_.deadlines(); }

 private:
  link::SystemClock clock_;
  app::Pacer<link::SystemClock> pacer_{clock_};
  bool real_time_ = false, urgent_ = false;
};

/// Robots in one session, and who drives them.
class Team {
 public:
  Team(const WalkOptions& options, session::Session& session, cli::Progress& progress,
       WalkRadio* radio)
      : options_(options), session_(session), progress_(progress), radio_(radio) {}

  session::Robot& add(const WalkPlan& plan, session::Hooks hooks) {
    if (radio_ != nullptr) radio_->watch(plan, hooks);
    session::Robot& added = session_.add(plan, std::move(hooks), [&](session::Robot& robot) {
      return plan.link.empty() ? session::make_controller(robot) : served(plan, robot);
    });
    if (radio_ != nullptr) radio_->join(plan, added);
    return added;
  }

  /// Ends what is to end with a robot that lost its controller.
  void look_after_losses() {
    if (lost_.empty() || options_.team.go_on || ended_) return;
    ended_ = true;
    for (std::size_t i = 0; i < session_.size(); ++i) {
      session_.robot(i).fail(
          fmt::format("stopped, because {} lost its controller; --if-lost-go-on walks on", lost_));
    }
  }

 private:
  std::unique_ptr<session::Controller> served(const WalkPlan& plan, session::Robot& robot) {
    const std::string name = robot.name();
    try {
      return serve(plan, robot, name);
    } catch (const link::LinkError& error) {
      throw link::LinkError(error.kind(), fmt::format("robot {}: {}", name, error.what()));
    } catch (const link::EndpointError& error) {
      throw link::EndpointError(fmt::format("robot {}: {}", name, error.what()));
    }
  }

  std::unique_ptr<session::Controller> serve(const WalkPlan& plan, session::Robot& robot,
                                             const std::string& name) {
    const auto say = [this, name](const std::string& line) {
      progress_.clear();
      cli::complain(fmt::format("verp walk: {}: {}", name, line));
    };
    return session::make_served(
        robot, {.link = plan.link,
                .pace = session::Pace::kLockstep,
                .patience_s = options_.team.patience_s,
                .ends_with_controller = true,
                .told = say,
                .check =
                    [&params = robot.plan().params](const link::CanInterface& interface) {
                      check_bit_rate("verp walk", interface, params);
                    },
                .gave_up =
                    [this, name, say](const std::string& why) {
                      say(why);
                      if (lost_.empty()) lost_ = name;
                    }});
  }

  const WalkOptions& options_;
  session::Session& session_;
  cli::Progress& progress_;
  WalkRadio* radio_;  ///< null: nobody has one
  std::string lost_;  ///< the first that lost its controller
  bool ended_ = false;
};

}  // namespace

OtherFiles::OtherFiles(const WalkOptions& options, const WalkFiles& first,
                       const std::vector<WalkPlan>& others, LiveStream& live) {
  if (first.trace_path().empty() && !options.live.on) return;
  for (const WalkPlan& other : others) {
    WalkOptions own = options;
    own.report_folder.clear();
    // Of a controller outside only what the robot did is known; what it was told, it may record.
    const bool ours = other.link.empty();
    own.record_file =
        ours && !first.trace_path().empty() ? file_of(first.trace_path(), other.name) : "";
    own.board = other.board;
    files_.emplace_back(own, other, ours ? live.robot(other.name) : nullptr);
  }
}

void OtherFiles::finish(const Walks& walks) {
  for (std::size_t i = 0; i < files_.size(); ++i) files_[i].finish(walks.others[i].second, {});
}

std::string OtherFiles::name(std::size_t i) const {
  return files_.empty() ? "" : files_[i].trace_path().string();
}

std::vector<std::string> OtherFiles::lost() const {
  std::vector<std::string> lost;
  for (const WalkFiles& each : files_)
    lost.insert(lost.end(), each.lost().begin(), each.lost().end());
  return lost;
}

Walks walk_together(const WalkPlan& plan, const std::vector<WalkPlan>& others,
                    const WalkOptions& options, const sim::WorldOptions& world, WalkFiles& files,
                    OtherFiles& other_files, cli::Progress& progress, WalkCameras* cameras) {
  std::unique_ptr<WalkRadio> radio;  // outlives the session, whose buses have its modems
  session::Session session({.world = world, .interrupted = cli::interrupted});
  if (options.radio) radio = std::make_unique<WalkRadio>(options, session, 1 + others.size());
  Team team(options, session, progress, radio.get());
  session::Hooks hooks =
      shown(plan, files.trace(), progress, plan.params.name, files.wants_report());
  tell_falls(plan, progress, options.command, hooks);
  if (cameras != nullptr) cameras->watch(plan, hooks);
  const session::Robot& first = team.add(plan, std::move(hooks));
  for (std::size_t i = 0; i < others.size(); ++i) {
    session::Hooks own;
    own.trace = other_files.trace(i);
    tell_falls(others[i], progress, options.command, own);
    team.add(others[i], std::move(own));
  }
  const link::SystemClock clock;
  const std::uint64_t begun_us = clock.now_us();
  Pace pace(options.real_time, plan.params.period_us);
  std::string diverged;  // what was recorded up to there is kept, as of every other end
  try {
    while (const session::Robot* robot = session.tick()) {
      if (robot == &first) pace.next();
      team.look_after_losses();
    }
  } catch (const sim::Diverged& error) {
    diverged = error.what();
  }
  pace.end();
  if (cameras != nullptr) cameras->finish();
  Walks walks;
  walks.deadlines = pace.deadlines();
  walks.took_s = 1e-6 * static_cast<double>(clock.now_us() - begun_us);
  walks.result = session.result(0);
  if (!diverged.empty()) walks.result.failure = diverged;
  for (std::size_t i = 0; i < others.size(); ++i)
    walks.others.emplace_back(others[i].name, session.result(i + 1));
  if (session.scenery() != nullptr) walks.objects = objects_of(*session.scenery());
  if (radio) walks.radio = radio->json(), walks.radio_text = radio->text();
  return walks;
}

std::string team_text(const Walks& walks, const std::vector<WalkPlan>& others,
                      const OtherFiles& files, const sim::WorldOptions& world) {
  std::string out;
  if (world.scenery != nullptr)
    out = fmt::format("  {:<18}{}, {}\n", "world", world.scenery->name, world.scenery->file);
  for (const cli::Json& each : walks.objects) {
    const cli::Json& at = each["position_m"];
    out += fmt::format("  {:<18}at the end at {:.3f} {:.3f} {:.3f} m\n",
                       each["name"].get<std::string>(), at[0].get<double>(), at[1].get<double>(),
                       at[2].get<double>());
  }
  for (std::size_t i = 0; i < others.size(); ++i) {
    const auto& [name, result] = walks.others[i];
    const std::string trace = files.name(i);
    out += fmt::format("  {:<18}{}, {:.2f} m, {}{}{}\n", name,
                       result.failure.empty() ? "walked" : result.failure,
                       way_of(others[i], result).norm(),
                       others[i].link.empty() ? fmt::format("digest 0x{:016x}", result.digest)
                                              : "driven over " + driver_of(others[i]),
                       others[i].board.empty() ? "" : " on " + others[i].board,
                       trace.empty() || !others[i].link.empty() ? "" : ", " + trace);
  }
  return out + walks.radio_text;
}

cli::Json team_json(const Walks& walks, const std::vector<WalkPlan>& others,
                    const OtherFiles& files, const sim::WorldOptions& world) {
  cli::Json out = cli::Json::object();
  if (world.scenery != nullptr) out = {{"world", world.scenery->file}, {"objects", walks.objects}};
  for (std::size_t i = 0; i < others.size(); ++i) {
    const auto& [name, result] = walks.others[i];
    cli::Json row = {{"name", name},
                     {"model", others[i].params.name},
                     {"seed", others[i].twin.seed},
                     {"controller", driver_of(others[i])},
                     {"failure", result.failure},
                     {"ticks", result.ticks},
                     {"fallen", result.metrics.fallen},
                     {"start_m", {others[i].twin.start_m.x(), others[i].twin.start_m.y()}},
                     {"end_m", {result.end_m.x(), result.end_m.y()}},
                     {"digest", digest_json(others[i], result)}};
    if (!files.name(i).empty()) row["trace"] = files.name(i);
    out["others"].push_back(row);
  }
  if (!walks.radio.is_null()) out["radio"] = walks.radio;
  return out;
}

std::vector<std::string> failures_of(const Walks& walks, const OtherFiles& files) {
  std::vector<std::string> lines = files.lost();
  for (const auto& [name, result] : walks.others) {
    if (!result.failure.empty())
      lines.push_back(fmt::format("verp walk: {}: {}", name, result.failure));
  }
  return lines;
}

}  // namespace verp::tool
