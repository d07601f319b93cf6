#include "host/pictures/film.hpp"

#include <CLI/CLI.hpp>

#include "host/scene/build.hpp"
#include "host/scene/from_trace.hpp"
#include "host/scene/from_twin.hpp"
#include "host/session/session.hpp"
#include "host/tool/command.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_plan.hpp"

namespace verp::pictures {
namespace {

constexpr double kSlack_s = 1e-6;

/// Lets through what is at least so far apart.
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
  explicit WalkFilm(const tool::WalkOptions& options) : plan_(tool::make_plan(options)) {
    world_ = tool::world_of(options);
    tool::draw(options, plan_, world_);
    scene_ = scene::studio();
    scene::add_robot(scene_, plan_.entity);
  }

  double end_s() const override { return plan_.walk_s + 3; }  // it stands up first

  void play(double from_s, double every_s, const Show& show) override {
    Shutter shutter(from_s, every_s);
    bool enough = false;
    session::Hooks hooks;
    hooks.ticked = [&](const session::Tick& tick) {
      if (enough || !shutter.opens(tick.seen.truth.t_s)) return;
      enough = !show(scene::snapshot(tick, plan_.entity, plan_.params));
    };
    session::walk(plan_, hooks,
                  {.world = world_, .interrupted = [&] { return enough || tool::interrupted(); }});
  }

 private:
  session::WalkPlan plan_;
  sim::WorldOptions world_;
};

class TraceFilm final : public Film {
 public:
  explicit TraceFilm(const std::string& file) : player_(file) {
    scene_ = scene::studio();
    scene::add_robot(scene_, player_.entity());
    note_ = player_.note();
  }

  double end_s() const override { return player_.end_s(); }

  void play(double from_s, double every_s, const Show& show) override {
    Shutter shutter(std::max(from_s, player_.begin_s()), every_s);
    for (std::size_t i = player_.index_at(from_s); i < player_.size(); ++i) {
      const double t_s = player_.trace().ticks[i].inputs.tick * player_.trace().period_s();
      if (!shutter.opens(t_s)) continue;
      if (tool::interrupted() || !show(player_.at(i))) return;
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

void declare_film(CLI::App& app, tool::WalkOptions& options) {
  tool::declare_gait(app, options);
  app.get_option("MODEL")->description("a robot, the path of an SDF file, or of a trace (.mcap)");
  tool::declare_tuning(app, options);
  app.add_option("--seed", options.seed, "of every random thing in the twin")
      ->check(tool::whole_number_between(0, 4294967295))
      ->capture_default_str();
}

}  // namespace verp::pictures
