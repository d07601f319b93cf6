#include "host/tool/walk_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/record/trace_error.hpp"
#include "host/sim/planned_zmp.hpp"
#include "host/tool/interrupt.hpp"

namespace verp::tool {
namespace {

constexpr double kAfterFall_s = 0.5;  // the report should show how it fell
constexpr double kAfterStop_s = 0.3;  // and how it stands still

record::ros::BodyPose pose_of(const sim::Transform& body) {
  const Eigen::Quaterniond q(body.linear());
  const auto& p = body.translation();
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

sim::TwinOptions twin_options(const WalkPlan& plan) {
  sim::TwinOptions options;
  options.seed = plan.seed;
  return options;
}

}  // namespace

WalkSession::WalkSession(const WalkPlan& plan, record::TraceWriter* trace, Progress& progress,
                         std::string label, bool keep_series)
    : plan_(plan),
      trace_(trace),
      progress_(progress),
      label_(std::move(label)),
      robot_(world_, plan.entity, twin_options(plan)),
      walker_(std::in_place, plan.params, plan.velocity, plan.walk_s),
      meter_(plan.entity, keep_series) {
  if (plan.params.bus_protocol == BusProtocol::kCia402) {
    can_.emplace(plan.params, robot_);
  } else {
    bus_.emplace(plan.params, robot_);
  }
}

bool WalkSession::over() const {
  return over_ || interrupted();
}

double WalkSession::simulated_s() const {
  return static_cast<double>(world_.now_us()) * 1e-6;
}

double WalkSession::walked_s() const {
  return walked_s_ + walker_->walked_s();
}

void WalkSession::begin_anew() {
  walked_s_ = walked_s();
  walker_.emplace(plan_.params, plan_.velocity, std::max(0.0, plan_.walk_s - walked_s_));
  trace_ = nullptr;
}

void WalkSession::record(const TickRecord& tick, const State& state, const Outputs& outputs) {
  walker_->observe(state, outputs);
  const gait::Xy by_m = state.gait.footsteps.stride.by_m;
  if (state.gait.queued > 0) {
    result_.longest_step_m =
        std::max(result_.longest_step_m,
                 std::hypot(static_cast<double>(by_m.x), static_cast<double>(by_m.y)));
  }
  const sim::Observation seen = sim::observe(robot_);
  meter_.tick(seen, outputs, sim::planned_zmp_world_m(state.tuning, state.gait, seen.truth));
  if (can_ && result_.ticks == 0) {
    bits_before_ = can_->bits_on_wire();
    bare_bits_before_ = can_->bare_bits_on_wire();
  }
  ++result_.ticks;
  result_.digest = tick.digest.chain;
  result_.faults = outputs.faults;
  if (trace_ != nullptr) {
    append(tick, state, outputs.faults, seen.truth.body_world);
  }
  const bool ended = robot_.fallen() || walker_->done();
  after_s_ += ended ? plan_.params.period_us * 1e-6 : 0;
  over_ = after_s_ > (robot_.fallen() ? kAfterFall_s : kAfterStop_s);
  progress_.show(walked_s() / plan_.walk_s,
                 fmt::format("{}  {:.1f} of {:g} s", label_, walked_s(), plan_.walk_s));
}

bool WalkSession::has_torque() {
  for (int j = 0; j < plan_.params.joint_count; ++j) {
    if (robot_.setpoint(j).torque_on) return true;
  }
  return false;
}

void WalkSession::watch() {
  const bool torque = has_torque();
  watched_ = true;
  if (!torque && !verdict_.driven()) return;
  if (!verdict_.driven()) begun_s_ = simulated_s();
  const Outputs nothing;
  const sim::Observation seen = sim::observe(robot_);
  meter_.tick(seen, nothing);
  ++result_.ticks;
  const double up = std::clamp(seen.truth.body_world.linear()(2, 2), -1.0, 1.0);
  verdict_.see(torque, std::acos(up), robot_.fallen());
  const double served_s = simulated_s() - begun_s_;
  after_s_ += verdict_.fell() ? plan_.params.period_us * 1e-6 : 0;
  over_ = served_s >= plan_.walk_s || after_s_ > kAfterFall_s;
  progress_.show(served_s / plan_.walk_s,
                 fmt::format("{}  {:.1f} of {:g} s", label_, served_s, plan_.walk_s));
}

WalkResult WalkSession::result(double wall_s, std::string failure) {
  result_.wall_s = wall_s;
  result_.simulated_s = simulated_s();
  result_.interrupted = interrupted();
  result_.metrics = meter_.result();
  if (watched_) {
    result_.simulated_s = verdict_.driven() ? simulated_s() - begun_s_ : 0;
    result_.metrics.fallen = verdict_.fell();
  }
  result_.series = meter_.series();
  if (can_) count_traffic();
  result_.failure = std::move(failure);
  if (result_.failure.empty() && !result_.interrupted) result_.failure = failure_of_walk();
  if (result_.good() && walker_->longer_than_asked()) {
    result_.remark = fmt::format("{:g} s were asked; the shortest walk with this cycle is {:.2f} s",
                                 plan_.walk_s, result_.metrics.walk_s);
  }
  return std::move(result_);
}

void WalkSession::count_traffic() {
  const double ticks = std::max(1.0, static_cast<double>(result_.ticks) - 1);
  const auto each_tick = [&](std::uint64_t now, std::uint64_t before) {
    return static_cast<double>(now - before) / ticks;
  };
  result_.can =
      CanTraffic{each_tick(can_->bits_on_wire(), bits_before_),
                 each_tick(can_->bare_bits_on_wire(), bare_bits_before_), can_->errors().overruns};
}

/// A disk that is full costs the trace, not the walk.
void WalkSession::append(const TickRecord& tick, const State& state, std::uint32_t faults,
                         const sim::Transform& body_world) {
  try {
    const record::ros::BodyPose body = pose_of(body_world);
    trace_->append(tick, state, faults, &body);
  } catch (const record::TraceError& error) {
    result_.trace_failure = error.what();
    trace_ = nullptr;
  }
}

std::string WalkSession::failure_of_walk() const {
  constexpr std::uint32_t kStopping = 0xFFFF;  // the lower half of Fault stops the robot
  if (watched_) return verdict_.fell() ? "fell" : "";
  if (result_.can && result_.can->overruns > 0) {
    return fmt::format("the controller lost {} CAN frames that it had no room for",
                       result_.can->overruns);
  }
  if (result_.metrics.fallen) {
    return fmt::format("fell after {:.2f} s of gait", walked_s());
  }
  const std::string faults = fault_names(result_.faults & kStopping);
  return faults.empty() ? walker_->failed() : "stopped by fault: " + faults;
}

}  // namespace verp::tool
