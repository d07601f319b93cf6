#include "host/study/survey/push_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "common/gait/types.hpp"
#include "common/safety/machine.hpp"
#include "host/run/session/session.hpp"

namespace verp::survey {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;

constexpr double kStandUp_s = 15;  // to rise and calibrate the gyro

/// The cycle of a run without push; length 0 for a standing robot.
struct Cycle {
  double begins_s = 0, cycle_s = 0;
  std::vector<double> heading_rad;  ///< at each phase
};

/// Finds the first steady cycle after settle_s.
class CycleFinder {
 public:
  CycleFinder(const PushOptions& options, double cycle_s) : options_(options) {
    found_.cycle_s = cycle_s;
  }

  void see(const session::Tick& tick) {
    const int before = std::exchange(state_, tick.outputs->gait_state);
    const bool steady = tick.outputs->gait_phase == static_cast<int>(gait::Phase::kTransition);
    if (!begun_ && steady && state_ < before && tick.gone_s >= options_.settle_s) {
      begun_ = true;
      found_.begins_s = tick.gone_s;
    }
    const auto phase = static_cast<double>(found_.heading_rad.size());
    const double at_s = found_.begins_s + found_.cycle_s * phase / options_.phases;
    if (begun_ && !whole() && tick.gone_s >= at_s - 1e-9)
      found_.heading_rad.push_back(tick.seen.truth.yaw_rad);
  }
  bool whole() const {
    return found_.heading_rad.size() == static_cast<std::size_t>(options_.phases);
  }
  const Cycle& found() const { return found_; }

 private:
  const PushOptions& options_;
  Cycle found_;
  int state_ = 0;
  bool begun_ = false;
};

class Stander {
 public:
  app::OperatorOrder operator()(std::uint32_t tick) {
    constexpr std::uint32_t kEvery = 10;  // well inside command_hold_s
    app::OperatorOrder order;
    order.command.request = Request::kStand;
    if (tick % kEvery == 0) ++sequence_, order.flags = kCommandFresh;
    order.command.sequence = sequence_;
    return order;
  }

 private:
  decltype(Command::sequence) sequence_ = 0;
};

bool stands(const session::Tick& tick) {
  return tick.outputs->mode == static_cast<std::uint8_t>(safety::Mode::kStanding);
}

/// The moment when it has stood for settle_s; nullopt: interrupted.
std::optional<Cycle> stance_of(session::WalkPlan plan, const sim::WorldOptions& world,
                               const PushOptions& options, const Watch& watch) {
  Cycle found;
  double since_s = 0;
  session::Hooks hooks;
  hooks.order = Stander();
  hooks.ticked = [&](const session::Tick& tick) {
    if (!stands(tick)) since_s = tick.gone_s;
    if (!found.heading_rad.empty() || tick.gone_s - since_s < options.settle_s) return;
    found.begins_s = tick.gone_s;
    found.heading_rad = {tick.seen.truth.yaw_rad};
  };
  plan.walk_s = kStandUp_s;
  const session::WalkResult result =
      session::walk(plan, hooks, {.world = world, .interrupted = watch.interrupted});
  if (result.interrupted) return std::nullopt;
  if (!result.failure.empty() || found.heading_rad.empty()) {
    throw SurveyError("it does not stand without a push" +
                      (result.failure.empty() ? "" : ": " + result.failure));
  }
  return found;
}

/// nullopt: interrupted.
std::optional<Cycle> cycle_of(const session::WalkPlan& plan, const sim::WorldOptions& world,
                              const PushOptions& options, const Watch& watch) {
  CycleFinder finder(options, static_cast<double>(plan.params.tuning.gait.cycle_s));
  session::Hooks hooks;
  hooks.ticked = [&](const session::Tick& tick) { finder.see(tick); };
  const session::WalkResult result =
      session::walk(plan, hooks, {.world = world, .interrupted = watch.interrupted});
  if (result.interrupted) return std::nullopt;
  if (!result.failure.empty())
    throw SurveyError("it walks badly without a push: " + result.failure);
  if (!finder.whole()) {
    throw SurveyError(
        fmt::format("no cycle was steady after {:g} s of gait; walk longer", options.settle_s));
  }
  return finder.found();
}

class Map {
 public:
  Map(const session::WalkPlan& plan, const sim::WorldOptions& world, const PushOptions& options,
      const Watch& watch)
      : plan_(plan),
        world_(world),
        options_(options),
        workers_(watch, cells() * static_cast<std::size_t>(walks_per_cell())) {
    map_.link = plan.entity.nodes.front().name;
  }

  PushMap run(const Cycle& cycle) {
    for (int phase = 0; phase < options_.phases; ++phase) {
      for (int direction = 0; direction < options_.directions; ++direction) {
        // -180 to 180 degrees: positive is left.
        const double turn_rad =
            std::remainder(kTurn_rad * direction / options_.directions, kTurn_rad);
        map_.cells.push_back({phase,
                              turn_rad,
                              cycle.begins_s + cycle.cycle_s * phase / options_.phases,
                              cycle.heading_rad[static_cast<std::size_t>(phase)],
                              {}});
      }
    }
    workers_.run(map_.cells.size(), [&](std::size_t i) {
      PushCell& cell = map_.cells[i];
      cell.survives_n_s = largest(cell);
    });
    map_.walks = walks_;
    map_.interrupted = workers_.stopped();
    return std::move(map_);
  }

 private:
  std::size_t cells() const {
    return static_cast<std::size_t>(options_.phases) *
           static_cast<std::size_t>(options_.directions);
  }
  int walks_per_cell() const { return static_cast<int>(std::ceil(std::log2(options_.steps + 1))); }

  std::optional<double> largest(const PushCell& cell) {
    int survived = 0, too_much = options_.steps + 1, left = walks_per_cell();
    while (too_much - survived > 1) {
      const int half = (survived + too_much) / 2;
      const bool good = survives(cell, half * options_.step_n_s);
      if (workers_.stopped()) return std::nullopt;
      (good ? survived : too_much) = half;
      workers_.step_done(), --left;
    }
    for (; left > 0; --left) workers_.step_done();
    return survived * options_.step_n_s;
  }

  bool survives(const PushCell& cell, double impulse_n_s) {
    session::WalkPlan plan = plan_;
    const double force_n = impulse_n_s / options_.push_s;
    const double to_rad = cell.heading_rad + cell.direction_rad;
    plan.interventions.push_back(
        {.kind = session::Intervention::Kind::kPush,
         .at_s = cell.at_s,
         .name = map_.link,
         .force_world_n = {force_n * std::cos(to_rad), force_n * std::sin(to_rad), 0},
         .for_s = options_.push_s});
    ++walks_;
    bool ends_well = true;
    session::Hooks hooks;
    if (options_.standing) {
      plan.walk_s = cell.at_s + options_.after_s;
      hooks.order = Stander();
      hooks.ticked = [&](const session::Tick& tick) { ends_well = stands(tick); };
    }
    const session::WalkResult result = session::walk(
        plan, hooks, {.world = world_, .interrupted = [&] { return workers_.stopped(); }});
    return result.good() && ends_well;
  }

  const session::WalkPlan& plan_;
  const sim::WorldOptions& world_;
  const PushOptions& options_;
  Workers workers_;
  std::atomic<std::size_t> walks_ = 0;
  PushMap map_;
};

}  // namespace

PushOptions standing_pushes() {
  return {.standing = true, .phases = 1};
}

double least_walk_s(const PushOptions& options, double cycle_s) {
  return options.settle_s + 2 * cycle_s + options.after_s;
}

PushMap push_map(const session::WalkPlan& plan, const sim::WorldOptions& world,
                 const PushOptions& options, const Watch& watch) {
  const std::optional<Cycle> cycle = options.standing ? stance_of(plan, world, options, watch)
                                                      : cycle_of(plan, world, options, watch);
  if (!cycle) return {.link = plan.entity.nodes.front().name, .cells = {}, .interrupted = true};
  return Map(plan, world, options, watch).run(*cycle);
}

}  // namespace verp::survey
