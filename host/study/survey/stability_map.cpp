#include "host/study/survey/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/run/session/session.hpp"
#include "host/run/session/stride.hpp"

namespace verp::survey {
namespace {

using End = StabilityCell::End;

/// Mean speed over whole cycles: sway cancels.
class SpeedMeter {
 public:
  SpeedMeter(double begin_s, double end_s, double cycle_s)
      : begin_s_(begin_s), end_s_(begin_s + cycle_s * std::floor((end_s - begin_s) / cycle_s)) {}

  void see(const session::Tick& tick) {
    const sim::Truth& truth = tick.seen.truth;
    const sim::Vec3 here_m = truth.body_world.translation();
    if (tick.gone_s > begin_s_ && tick.gone_s <= end_s_ + 1e-9 && last_s_ >= 0) {
      const sim::Vec3 by_m = here_m - last_m_;
      const double c = std::cos(truth.yaw_rad), s = std::sin(truth.yaw_rad);
      sum_.vx_m_s += c * by_m.x() + s * by_m.y();
      sum_.vy_m_s += c * by_m.y() - s * by_m.x();
      sum_.wz_rad_s += std::remainder(truth.yaw_rad - last_yaw_rad_, 2 * std::numbers::pi);
      time_s_ += truth.t_s - last_s_;
    }
    last_s_ = truth.t_s;
    last_m_ = here_m;
    last_yaw_rad_ = truth.yaw_rad;
  }
  Velocity mean() const {
    const double s = std::max(time_s_, 1e-9);
    return {sum_.vx_m_s / s, sum_.vy_m_s / s, sum_.wz_rad_s / s};
  }
  bool whole() const { return end_s_ > begin_s_ && time_s_ > end_s_ - begin_s_ - 0.05; }

 private:
  double begin_s_, end_s_, last_s_ = -1, last_yaw_rad_ = 0, time_s_ = 0;
  sim::Vec3 last_m_ = sim::Vec3::Zero();
  Velocity sum_;
};

constexpr double kStopping_s = 1.5;  // for the gait's end

void walk(session::WalkPlan plan, const sim::WorldOptions& world, const StabilityOptions& options,
          Workers& workers, StabilityCell& cell) {
  const session::FeasibleVelocity followed =
      session::within_servo_speed(plan.params, command_of(cell.asked));
  plan.velocity = followed.velocity;
  plan.asked.reset();  // the map has both velocities
  SpeedMeter meter(options.begin_s, plan.walk_s - kStopping_s,
                   static_cast<double>(plan.params.tuning.gait.cycle_s));
  session::Hooks hooks;
  hooks.ticked = [&](const session::Tick& tick) { meter.see(tick); };
  const session::WalkResult result = session::walk(
      plan, hooks, {.world = world, .interrupted = [&] { return workers.stopped(); }});
  if (workers.stopped()) return;
  cell.ordered = velocity_of(plan.velocity);
  cell.why = result.failure;
  const bool short_of_it = meter.whole();  // it walked to the end, but less far
  cell.end = result.metrics.fallen    ? End::kFell
             : result.failure.empty() ? End::kWalked
             : short_of_it            ? End::kShort
                                      : End::kFailed;
  if (cell.end == End::kWalked || cell.end == End::kShort) cell.walked = meter.mean();
  workers.step_done();
}

}  // namespace

Command command_of(const Velocity& velocity) {
  Command command;
  command.vx_tenth_mm_s = static_cast<std::int16_t>(std::lround(1e4 * velocity.vx_m_s));
  command.vy_tenth_mm_s = static_cast<std::int16_t>(std::lround(1e4 * velocity.vy_m_s));
  command.wz_mrad_s = static_cast<std::int16_t>(std::lround(1e3 * velocity.wz_rad_s));
  return command;
}

Velocity velocity_of(const Command& command) {
  return {1e-4 * command.vx_tenth_mm_s, 1e-4 * command.vy_tenth_mm_s, 1e-3 * command.wz_mrad_s};
}

Velocity most_of(const Params& params) {
  const GaitTuning& gait = params.tuning.gait;
  const double steps_s = 2 / static_cast<double>(gait.cycle_s);
  const double speed_m_s = steps_s * static_cast<double>(gait.max_step_m);
  return {speed_m_s, speed_m_s / 2, steps_s * static_cast<double>(gait.max_turn_rad)};
}

const char* name_of(End end) {
  constexpr const char* kNames[] = {"not walked", "walked", "short", "fell", "failed"};
  return kNames[static_cast<int>(end)];
}

double least_walk_s(const StabilityOptions& options, double cycle_s) {
  return options.begin_s + cycle_s + kStopping_s;
}

StabilityMap stability_map(const session::WalkPlan& plan, const sim::WorldOptions& world,
                           const StabilityOptions& options, const Watch& watch) {
  StabilityMap map;
  const int half = options.on_axis / 2;
  const auto add = [&](int x, int y, int turn) {
    const Velocity& most = options.most;
    StabilityCell cell;
    cell.asked = {most.vx_m_s * x / half, most.vy_m_s * y / half, most.wz_rad_s * turn / half};
    map.cells.push_back(cell);
  };
  for (int x = -half; x <= half; ++x) {
    for (int turn = -half; turn <= half; ++turn) add(x, 0, turn);
  }
  for (int x = -half; x <= half; ++x) {
    for (int y = -half; y <= half; ++y) {
      if (y != 0) add(x, y, 0);
    }
  }
  Workers workers(watch, map.cells.size());
  workers.run(map.cells.size(),
              [&](std::size_t i) { walk(plan, world, options, workers, map.cells[i]); });
  map.interrupted = workers.stopped();
  return map;
}

}  // namespace verp::survey
