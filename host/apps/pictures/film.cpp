#include "host/apps/pictures/film.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/run/session/session.hpp"
#include "host/show/scene/build.hpp"
#include "host/show/scene/from_trace.hpp"
#include "host/show/scene/from_twin.hpp"
#include "host/twin/sim/scenery.hpp"

namespace verp::pictures {
namespace {

constexpr double kSlack_s = 1e-6;

/// Passes instants at least every_s apart.
class Shutter {
 public:
  Shutter(double from_s, double every_s) : next_s_(from_s), every_s_(every_s) {}
  bool opens(double t_s) {
    if (t_s < next_s_ - kSlack_s) return false;
    next_s_ = std::max(next_s_ + every_s_, t_s - every_s_);
    return true;
  }

 private:
  double next_s_, every_s_;
};

class WalkFilm final : public Film {
 public:
  explicit WalkFilm(const tool::WalkOptions& options) : run_(tool::walk_of(options).run) {
    scene_ = scene::surroundings(run_.world.scenery.get());
    for (const session::WalkPlan& plan : run_.plans) scene::add_robot(scene_, plan.entity);
  }

  double end_s() const override { return run_.plans.front().walk_s + 3; }  // the robot stands up

  void play(double from_s, double every_s, const Show& show) override {
    Shutter shutter(from_s, every_s);
    bool enough = false;
    session::Session session(
        {.world = run_.world, .interrupted = [&] { return enough || cli::interrupted(); }});
    std::vector<scene::RobotView> seen;
    for (std::size_t i = 0; i < run_.plans.size(); ++i) {
      const session::WalkPlan& plan = run_.plans[i];
      seen.push_back(scene::standing(plan.entity, plan.twin.start_m, plan.twin.start_yaw_rad));
      session::Hooks hooks;
      hooks.ticked = [&, i](const session::Tick& tick) {
        if (enough) return;
        if (i > 0) return void(seen[i] = scene::look(tick, plan.entity, plan.params));
        if (!shutter.opens(tick.seen.truth.t_s)) return;
        scene::Snapshot now = scene::snapshot(tick, plan.entity, plan.params);
        now.robots.insert(now.robots.end(), seen.begin() + 1, seen.end());
        enough = !show(std::move(now));
      };
      session.add(plan, std::move(hooks));
    }
    while (session.tick() != nullptr) {
    }
  }

  /// The twin's first stance.
  scene::Snapshot start() const override {
    const sim::World world(run_.world);
    scene::Snapshot now;
    for (const session::WalkPlan& plan : run_.plans) {
      sim::Vec3 at_m = plan.twin.start_m;
      at_m.z() = session::ground_m(world, at_m);
      now.robots.push_back(scene::standing(plan.entity, at_m, plan.twin.start_yaw_rad));
    }
    if (world.scenery() != nullptr) now.body_world = world.scenery()->moving_poses();
    return now;
  }

 private:
  const scenario::Expanded run_;
};

class TraceFilm final : public Film {
 public:
  explicit TraceFilm(const std::string& file) : player_(file) {
    scene_ = scene::surroundings(player_.world());
    scene::add_robot(scene_, player_.entity());
    note_ = player_.note();
  }

  double end_s() const override { return player_.end_s(); }
  scene::Snapshot start() const override { return player_.at(0); }

  void play(double from_s, double every_s, const Show& show) override {
    Shutter shutter(std::max(from_s, player_.begin_s()), every_s);
    for (std::size_t i = player_.index_at(from_s); i < player_.size(); ++i) {
      const double t_s = player_.trace().ticks[i].inputs.tick * player_.trace().period_s();
      if (!shutter.opens(t_s)) continue;
      if (cli::interrupted() || !show(player_.at(i))) return;
    }
  }

 private:
  scene::TracePlayer player_;
};

}  // namespace

bool is_trace(const tool::WalkOptions& options) {
  return options.model.ends_with(".mcap");
}

std::unique_ptr<Film> open_film(const tool::WalkOptions& options) {
  if (is_trace(options)) return std::make_unique<TraceFilm>(options.model);
  return std::make_unique<WalkFilm>(options);
}

void refuse_walk_of_trace(const CLI::App& app, const tool::WalkOptions& options) {
  if (!is_trace(options)) return;
  for (const char* name : {"--bus", "--step", "--velocity", "--for", "--cycle", "--set", "--world",
                           "--at-pose", "--robots", "--seed"}) {
    if (app.count(name) == 0) continue;
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("{}: {} is of a walk in the twin, and {} is a trace, which shows what was "
                    "recorded; name a robot, or leave out {}",
                    options.command, name, options.model, name));
  }
}

void declare_film(CLI::App& app, tool::WalkOptions& options) {
  tool::declare_gait(app, options);
  app.get_option("MODEL")->description("a robot, the path of an SDF file, or of a trace (.mcap)");
  tool::declare_tuning(app, options);
  tool::declare(app, options.place);
  tool::declare_robots(app, options.team);
  app.add_option("--seed", options.seed, "of every random thing in the twin")
      ->check(cli::whole_number_between(0, 4294967295))
      ->capture_default_str();
}

}  // namespace verp::pictures
