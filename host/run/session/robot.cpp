#include "host/run/session/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "common/control/step.hpp"
#include "common/safety/limit.hpp"
#include "host/run/session/asked.hpp"
#include "host/run/session/fault_names.hpp"
#include "host/run/session/readings.hpp"
#include "host/trace/record/trace_error.hpp"
#include "host/twin/sim/planned_zmp.hpp"
#include "host/twin/sim/scenery.hpp"

namespace verp::session {
namespace {

constexpr double kAfterFall_s = 0.5;         // the report shows the fall
constexpr double kAfterStop_s = 0.3;         // the report shows the stand
constexpr std::uint32_t kStopping = 0xFFFF;  // faults that stop the robot
constexpr const char* kByFault = "stopped by fault: ";

Hooks with_own(Hooks hooks, const WalkPlan& plan) {
  if (!hooks.decide && plan.own) hooks.decide = plan.own();
  return hooks;
}

record::ros::BodyPose pose_of(const sim::Transform& body) {
  const Eigen::Quaterniond q(body.linear());
  const auto& p = body.translation();
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

std::vector<record::ros::ObjectPose> objects_of(const sim::Scenery& scenery) {
  const std::vector<sim::Transform> poses = scenery.moving_poses();
  std::vector<record::ros::ObjectPose> out;
  for (const model::WorldObject* object : model::moving(scenery.data()))
    out.push_back({object->name, pose_of(poses[out.size()])});
  return out;
}

}  // namespace

Robot::Robot(sim::World& world, const WalkPlan& plan, Hooks hooks, Interrupted interrupted)
    : plan_(plan),
      hooks_(with_own(std::move(hooks), plan_)),
      interrupted_(std::move(interrupted)),
      trace_(hooks_.trace),
      world_(world),
      twin_(world, plan_.entity, plan_.twin),
      walker_(std::in_place, plan_.params, plan_.velocity, plan_.walk_s, plan_.get_ups,
              plan_.stands),
      meter_(plan_.entity, hooks_.keep_series),
      pending_(plan_.interventions.begin(), plan_.interventions.end()),
      story_(plan_.get_ups) {
  std::stable_sort(pending_.begin(), pending_.end(),
                   [](const Intervention& a, const Intervention& b) { return a.at_s < b.at_s; });
  if (plan_.params.bus_protocol == BusProtocol::kCia402) {
    can_.emplace(plan_.params, twin_);
  } else {
    Params devices = plan_.params;
    if (plan_.fault && plan_.fault->devices) plan_.fault->devices(devices);
    bus_.emplace(devices, twin_);
  }
  if (!plan_.fault) return;
  if (plan_.fault->line && bus_) line_.emplace(*bus_, static_cast<std::uint32_t>(plan_.twin.seed));
  if (plan_.fault->at_s < 0) go_wrong();
}

/// Begins the plan's fault, or goes on with it.
void Robot::go_wrong() {
  const Fault& fault = *plan_.fault;
  if (!std::exchange(wrong_, true)) {
    if (line_ && fault.line) line_->faults = *fault.line;
    if (fault.begin) fault.begin(*this);
  } else if (fault.each_tick) {
    fault.each_tick(*this);
  }
}

bool Robot::over() const {
  return over_ || interrupted();
}

void Robot::fail(const std::string& why) {
  if (result_.failure.empty()) result_.failure = why;
  over_ = true;
}

double Robot::simulated_s() const {
  return static_cast<double>(twin_.now_us()) * 1e-6;
}

double Robot::walked_s() const {
  return walked_s_ + walker_->walked_s();
}

double Robot::gone_s() const {
  if (!watched_ && !hooks_.order) return walked_s();
  const bool begun = watched_ ? verdict_.driven() : result_.ticks > 0;
  return begun ? simulated_s() - begun_s_ : 0;
}

app::OperatorOrder Robot::order(std::uint32_t tick) {
  app::OperatorOrder order = hooks_.order ? hooks_.order(tick) : walker_->order(tick);
  if (hooks_.amend) hooks_.amend(tick, order);
  if (wrong_ && plan_.fault->amend) plan_.fault->amend(order);
  return order;
}

void Robot::decide(State& state, const Inputs& inputs, Outputs& outputs) {
  if (hooks_.decide) return hooks_.decide(plan_.params, state, inputs, outputs);
  step(plan_.params, actions(), state, inputs, outputs);
}

void Robot::let_pass(std::uint32_t time_us) {
  can_ ? can_->let_pass(can_->now_us() + time_us) : bus_->let_pass(bus_->now_us() + time_us);
}

void Robot::begin_anew() {
  walked_s_ = walked_s();
  walker_.emplace(plan_.params, plan_.velocity, std::max(0.0, plan_.walk_s - walked_s_),
                  plan_.get_ups, plan_.stands);
  trace_ = nullptr;
}

void Robot::take(const TickRecord& tick, const State& state, const Outputs& outputs) {
  tick_ = tick;
  state_ = state;
  outputs_ = outputs;
  taken_ = true;
}

void Robot::see() {
  if (!std::exchange(taken_, false)) return;
  walker_->observe(state_, outputs_);
  look_after_falls();
  const gait::Xy by_m = state_.gait.footsteps.stride.by_m;
  if (state_.gait.queued > 0) {
    result_.longest_step_m =
        std::max(result_.longest_step_m,
                 std::hypot(static_cast<double>(by_m.x), static_cast<double>(by_m.y)));
  }
  const sim::Observation seen = sim::observe(twin_);
  if (culprit_.empty()) culprit_ = culprit(seen.truth);
  strain_.see(twin_, outputs_.faults);
  meter_.tick(seen, outputs_, sim::planned_zmp_world_m(state_.tuning, state_.gait, seen.truth));
  estimate_meter_.tick(state_, outputs_, seen.truth, world_.options().up.normalized());
  if (result_.ticks == 0) {
    begun_s_ = simulated_s();
    if (can_) {
      bits_before_ = can_->bits_on_wire();
      bare_bits_before_ = can_->bare_bits_on_wire();
    }
  }
  suspicions_.tick(plan_.params, tick_.inputs, state_);
  late_ticks_ += (outputs_.faults & safety::kNoteOverrun) != 0 ? 1 : 0;
  ++result_.ticks;
  result_.digest = tick_.digest.chain;
  result_.faults = outputs_.faults;
  std::vector<sim::Scan> scans;
  if (trace_ != nullptr || hooks_.scanned) scans = twin_.take_scans();
  if (trace_ != nullptr) append(seen.truth, scans);
  tell(scans);
  tell_exposures();
  const bool done = hooks_.order ? gone_s() >= plan_.walk_s : walker_->done();
  intervene_in_time();
  const bool ended = done || (twin_.fallen() && plan_.get_ups == 0);
  after_s_ += ended ? plan_.params.period_us * 1e-6 : 0;
  const bool ends = after_s_ > (twin_.fallen() ? kAfterFall_s : kAfterStop_s);
  over_ = over_ || (ends && !hooks_.open_end);
  if (hooks_.ticked)
    hooks_.ticked({seen, gone_s(), &tick_, &state_, &outputs_, &world_, twin_.owner()});
}

/// A robot that got up walks on.
void Robot::look_after_falls() {
  tell(story_.observe(state_, outputs_));
  result_.falls = story_.falls();
  result_.get_ups = story_.get_ups();
  const bool stands = outputs_.mode == static_cast<std::uint8_t>(safety::Mode::kStanding);
  const bool gets_up = plan_.get_ups > 0 || story_.get_ups() > 0;
  if (stands && gets_up && twin_.fallen()) twin_.forget_fall();
}

void Robot::tell(const std::string& news) {
  if (news.empty()) return;
  result_.fall_story.push_back({simulated_s(), news});
  if (hooks_.told) hooks_.told(result_.fall_story.back());
}

void Robot::intervene_in_time() {
  constexpr double kRounding_s = 1e-9;  // of a long sum
  while (!pending_.empty() && pending_.front().at_s <= gone_s() + kRounding_s) {
    intervene(pending_.front());
    pending_.pop_front();
  }
  if (plan_.fault && (wrong_ || plan_.fault->at_s <= gone_s() + kRounding_s)) go_wrong();
}

void Robot::intervene(const Intervention& intervention) {
  apply(intervention, quantities_());
  const std::string what = in_words(intervention);
  result_.interventions.push_back({tick_.inputs.tick, simulated_s(), what});
  note(what);
}

/// A full disk ends the trace, not the walk.
void Robot::note(const std::string& what) {
  try {
    if (trace_ != nullptr) trace_->note(tick_.inputs.tick, what);
  } catch (const record::TraceError& error) {
    result_.trace_failure = error.what();
    trace_ = nullptr;
  }
}

bool Robot::has_torque() {
  for (int j = 0; j < plan_.params.joint_count; ++j) {
    if (twin_.setpoint(j).torque_on) return true;
  }
  return false;
}

double Robot::furthest_from_goal_rad(const sim::Truth& truth) {
  double furthest_rad = 0;
  for (std::size_t j = 0; j < truth.joint_rad.size(); ++j) {
    if (twin_.entity().joints[j].follows >= 0) continue;
    const int joint = static_cast<int>(j);
    const double goal_rad = sim::angle_of(twin_.entity().joints[j].servo,
                                          static_cast<double>(twin_.setpoint(joint).goal_count));
    furthest_rad = std::max(furthest_rad, std::abs(goal_rad - truth.joint_rad[j]));
  }
  return furthest_rad;
}

bool Robot::set_upright() {
  if (!twin_.set_upright()) return false;
  verdict_.set_upright();
  result_.set_upright_s.push_back(simulated_s());
  return true;
}

void Robot::watch() {
  const bool torque = has_torque();
  watched_ = true;
  if (!torque && !verdict_.driven()) return;
  if (!verdict_.driven()) begun_s_ = simulated_s();
  const Outputs nothing;
  const sim::Observation seen = sim::observe(twin_);
  meter_.tick(seen, nothing);
  ++result_.ticks;
  const double up = std::clamp(seen.truth.body_world.linear()(2, 2), -1.0, 1.0);
  const double tilt_rad = std::acos(up);
  descent_.see(tilt_rad, seen.truth.com_world_m.z(), seen.truth.com_velocity_world_m_s.z(),
               furthest_from_goal_rad(seen.truth));
  verdict_.see(torque, tilt_rad, twin_.fallen(), descent_.gentle(world_.options().gravity_m_s2));
  const bool may_get_up = plan_.get_ups > 0;  // then only staying down is a fall
  if (may_get_up && twin_.forget_fall()) verdict_.forget();
  if (twin_.fallen() && !std::exchange(lies_, true) && may_get_up) {
    const Eigen::Vector3d sky = seen.truth.body_world.linear().row(2);
    tell("lies " + how_it_lies(sky.x(), sky.y()));
  }
  if (!twin_.fallen() && std::exchange(lies_, false)) tell("is on its feet again");
  intervene_in_time();
  after_s_ += verdict_.fell() && !may_get_up ? plan_.params.period_us * 1e-6 : 0;
  over_ = over_ || gone_s() >= plan_.walk_s || after_s_ > kAfterFall_s;
  if (hooks_.ticked) {
    hooks_.ticked({.seen = seen, .gone_s = gone_s(), .world = &world_, .owner = twin_.owner()});
  }
}

WalkResult Robot::result(double wall_s) {
  result_.wall_s = wall_s;
  result_.simulated_s = simulated_s();
  result_.interrupted = interrupted();
  result_.metrics = meter_.result();
  result_.estimate = estimate_meter_.result();
  result_.end_m = twin_.truth().body_world.translation().head<2>();
  if (watched_) {
    result_.simulated_s = gone_s();
    result_.metrics.fallen = verdict_.fell();
  }
  result_.series = meter_.series();
  if (can_) count_traffic();
  if (result_.failure.empty() && !result_.interrupted) result_.failure = failure_of_walk();
  result_.remark = plan_.remark;
  const std::string doubt =
      suspicions_.text(world_.options().gravity_m_s2, world_.scenery() == nullptr);
  if (result_.good() && !watched_ && !doubt.empty())
    result_.remark += (result_.remark.empty() ? "" : "; ") + doubt;
  if (result_.good() && !hooks_.order && walker_->longer_than_asked()) {
    result_.remark +=
        fmt::format("{}{:g} s were asked; the shortest walk with this cycle is {:.2f} s",
                    result_.remark.empty() ? "" : "; ", plan_.walk_s, result_.metrics.walk_s);
  }
  if (result_.good() && !hooks_.order && !watched_ && walked_s_ <= 0) {
    const std::string slow =
        slow_start(plan_.asked.value_or(plan_.velocity), result_.metrics, plan_.params.tuning.gait);
    if (!slow.empty()) result_.remark += (result_.remark.empty() ? "" : "; ") + slow;
  }
  return std::move(result_);
}

void Robot::count_traffic() {
  const double ticks = std::max(1.0, static_cast<double>(result_.ticks) - 1);
  const auto each_tick = [&](std::uint64_t now, std::uint64_t before) {
    return static_cast<double>(now - before) / ticks;
  };
  result_.can =
      CanTraffic{each_tick(can_->bits_on_wire(), bits_before_),
                 each_tick(can_->bare_bits_on_wire(), bare_bits_before_), can_->errors().overruns};
}

void Robot::append(const sim::Truth& truth, const std::vector<sim::Scan>& scans) {
  try {
    const record::ros::BodyPose body = pose_of(truth.body_world);
    if (trace_->ticks() == 0) place_frames(*trace_, plan_.entity, plan_.params);
    trace_->append(tick_, state_, outputs_, &body, truth.torque_n_m);
    if (world_.scenery() != nullptr)
      trace_->append(tick_.inputs.tick, objects_of(*world_.scenery()));
    for (const sim::Scan& scan : scans) append(scan);
    session::append(*trace_, plan_.entity, twin_.take_readings(),
                    std::uint64_t{1000} * tick_.inputs.tick * plan_.params.period_us,
                    twin_.now_us());
  } catch (const record::TraceError& error) {
    result_.trace_failure = error.what();
    trace_ = nullptr;
  }
}

void Robot::append(const sim::Scan& scan) {
  const std::uint64_t age_us = twin_.now_us() - scan.time_us;
  if (age_us > std::uint64_t{tick_.inputs.tick} * plan_.params.period_us) return;  // before tick 0
  const model::LaserSensor& laser = plan_.entity.lasers[scan.laser];
  trace_->append(laser.name, tick_.inputs.tick,
                 record::ros::LaserScan{.frame = laser.name,
                                        .first_rad = laser.first_rad,
                                        .last_rad = laser.last_rad,
                                        .step_rad = laser.step_rad(),
                                        .period_s = 1 / laser.rate_hz,
                                        .min_m = laser.min_m,
                                        .max_m = laser.max_m,
                                        .range_m = scan.range_m,
                                        .age_ns = 1000 * age_us});
}

void Robot::tell(const std::vector<sim::Scan>& scans) const {
  if (!hooks_.scanned) return;
  const std::uint64_t tick_us = std::uint64_t{tick_.inputs.tick} * plan_.params.period_us;
  for (const sim::Scan& each : scans) {
    const std::uint64_t ago_us = twin_.now_us() - each.time_us;
    if (ago_us <= tick_us) hooks_.scanned(each, 1000 * (tick_us - ago_us));  // else: before tick 0
  }
}

void Robot::tell_exposures() {
  if (!hooks_.exposed || (hooks_.trace != nullptr && trace_ == nullptr)) return;
  const std::uint64_t tick_us = std::uint64_t{tick_.inputs.tick} * plan_.params.period_us;
  for (const sim::Exposure& each : twin_.take_exposures()) {
    const std::uint64_t ago_us = twin_.now_us() - each.time_us;
    if (ago_us <= tick_us) hooks_.exposed(each, 1000 * (tick_us - ago_us));  // else: before tick 0
  }
}

/// The device behind the faults of this tick; empty: unknown.
std::string Robot::culprit(const sim::Truth& truth) const {
  constexpr std::uint32_t kSilent = safety::kFaultServoSilent | safety::kFaultNotFollowing;
  constexpr std::uint32_t kTold = safety::kFaultTemperature | safety::kFaultServoError;
  constexpr int kFew = 6;
  const Params& params = plan_.params;
  const int silent = std::popcount(state_.machine.silent);
  const int beyond = safety::joint_beyond(params, tick_.inputs.position_count);
  if ((outputs_.faults & kSilent) != 0 && silent > 0)
    return silent > kFew ? fmt::format("{} servos", silent) : silent_device(params, state_);
  if ((outputs_.faults & kTold) != 0 && tick_.inputs.slow_joint < params.servo_count())
    return fmt::format("servo {}", params.joint[tick_.inputs.slow_joint].servo_id);
  if ((outputs_.faults & safety::kFaultJointBeyond) != 0 && beyond < kMaxJoints)
    return params.joint[beyond].name;
  const bool stands = truth.body_world.linear()(2, 2) > 0.9;
  return stands && state_.attitude.up_body.z < 0.5F ? "by its IMU it lies, and it stands" : "";
}

std::string Robot::failure_of_walk() const {
  std::string why = why_it_failed();
  if (why.empty() || watched_) return why;
  const auto known = twin_.fallen() ? std::uint32_t{safety::kFaultFall} : 0U;
  const std::string faults = fault_names(result_.faults & kStopping & ~known);
  if (!faults.empty() && !why.starts_with(kByFault)) why += "; fault: " + faults;
  const std::string numbers = strain_.text(plan_.params, result_.faults);
  const char* const both = culprit_.empty() || numbers.empty() ? "" : "; ";
  if (!culprit_.empty() || !numbers.empty())
    why += fmt::format(" ({}{}{})", culprit_, both, numbers);
  if (10 * late_ticks_ < result_.ticks) return why;
  return why +
         fmt::format("; its controller was late in {} of {} ticks", late_ticks_, result_.ticks);
}

std::string Robot::why_it_failed() const {
  if (watched_) return verdict_.fell() ? "fell" : "";
  if (result_.can && result_.can->overruns > 0) {
    return fmt::format("the controller lost {} CAN frames that it had no room for",
                       result_.can->overruns);
  }
  if (result_.metrics.fallen) {
    const std::string failed = hooks_.order ? "" : walker_->failed();
    const char* const of = plan_.stands ? "" : " of gait";
    const std::string fell = fmt::format("fell after {:.2f} s{}", walked_s(), of);
    const std::uint32_t others = result_.faults & kStopping & ~std::uint32_t{safety::kFaultFall};
    if (strain_.came_before_fall(others)) {
      return kByFault + fault_names(others) + ", and " +
             (walked_s() > 0 ? fell : std::string("fell before it walked"));
    }
    return failed.empty() ? fell : failed;
  }
  const std::string faults = fault_names(result_.faults & kStopping);
  if (!faults.empty()) return kByFault + faults;
  if (hooks_.order) return "";
  const std::string failed = walker_->failed();
  // A restart makes two walks: the way is not judged.
  if (!failed.empty() || walked_s_ > 0) return failed;
  return shortfall(plan_.asked.value_or(plan_.velocity), result_.metrics, plan_.params.tuning.gait);
}

}  // namespace verp::session
