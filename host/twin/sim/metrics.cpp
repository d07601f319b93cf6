#include "host/twin/sim/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/gait/types.hpp"

namespace verp::sim {
namespace {

/// Cycles left out at each end of the transition phase.
constexpr std::size_t kUnsteadyCycles = 2;

bool is_walking(const Outputs& outputs) {
  return outputs.gait_phase != static_cast<std::uint8_t>(gait::Phase::kIdle);
}

/// The midpoint of the soles; without soles, below the body.
Vec2 ground_position(const Truth& truth) {
  if (!truth.foot[0].present || !truth.foot[1].present)
    return truth.body_world.translation().head<2>();
  return (truth.foot[0].centroid_world_m + truth.foot[1].centroid_world_m).head<2>() / 2;
}

double ground_heading(const Truth& truth) {
  if (!truth.foot[0].present || !truth.foot[1].present) return truth.yaw_rad;
  const Vec3 x =
      truth.foot[0].sole_world.linear().col(0) + truth.foot[1].sole_world.linear().col(0);
  return std::atan2(x.y(), x.x());
}

}  // namespace

Observation observe(TwinRobot& robot) {
  return {robot.truth(),           robot.take_foot_loads(),    robot.steps(),
          robot.saturated_steps(), robot.self_contact_steps(), robot.self_contact_nodes(),
          robot.supply_energy_j(), robot.joint_work_j(),       robot.weight_n()};
}

WalkMeter::WalkMeter(const model::Entity& entity, bool keep_series)
    : joints_(entity.joints),
      keep_series_(keep_series),
      walk_saturated_(entity.joints.size(), 0),
      torque_use_sum_(entity.joints.size(), 0),
      torque_use_peak_(entity.joints.size(), 0) {
  for (const model::Node& node : entity.nodes) link_names_.push_back(node.name);
}

void WalkMeter::tick(const Observation& seen, const Outputs& outputs,
                     const std::optional<Vec2>& zmp_planned_world_m) {
  if (!started_) first_s_ = seen.truth.t_s;
  started_ = true;
  here_m_ = ground_position(seen.truth);
  if (walking_) score_past_tick(seen);
  const bool walks = is_walking(outputs) && !seen.truth.fallen;
  if (walks && !walking_) begin_walk(seen.truth);
  if (walks) follow_path(seen.truth, outputs);
  if (walks) add_torque_use(seen.truth);
  if (!walks && walking_) end_walk();
  walking_ = walks;
  previous_ = outputs;
  // A user controller may output any byte, and this value counts feet below.
  previous_.stance = std::min<std::uint8_t>(outputs.stance, gait::kBoth);
  last_ = seen;
  if (keep_series_) keep(seen, outputs, zmp_planned_world_m);
}

void WalkMeter::score_past_tick(const Observation& seen) {
  walk_s_ += seen.truth.t_s - last_.truth.t_s;
  walk_steps_ += seen.steps - last_.steps;
  supply_energy_j_ += seen.supply_energy_j - last_.supply_energy_j;
  joint_work_j_ += seen.joint_work_j - last_.joint_work_j;
  if (seen.self_contact_steps > last_.self_contact_steps) {
    ++self_contact_ticks_;
    self_contact_nodes_ = seen.self_contact_nodes;
  }
  for (std::size_t j = 0; j < walk_saturated_.size(); ++j) {
    walk_saturated_[j] += seen.saturated_steps[j] - last_.saturated_steps[j];
  }
  yaw_turned_rad_ += std::remainder(seen.truth.yaw_rad - last_.truth.yaw_rad, 2 * std::numbers::pi);
  score_zmp(seen.truth, seen.loads);
  add_slip(seen.truth);
}

void WalkMeter::add_slip(const Truth& truth) {
  if (previous_.stance == gait::kBoth) return;
  const auto& before = last_.truth.foot[previous_.stance];
  const auto& after = truth.foot[previous_.stance];
  if (std::min(before.normal_force_n, after.normal_force_n) < kContactForceN) return;
  slid_m_ += (after.centroid_world_m - before.centroid_world_m).head<2>();
}

void WalkMeter::add_torque_use(const Truth& truth) {
  if (truth.torque_use.size() != torque_use_sum_.size()) return;
  ++walk_ticks_;
  for (std::size_t j = 0; j < torque_use_sum_.size(); ++j) {
    torque_use_sum_[j] += truth.torque_use[j];
    torque_use_peak_[j] = std::max(torque_use_peak_[j], truth.torque_use[j]);
  }
}

void WalkMeter::score_transport(WalkMetrics& out) const {
  constexpr double kLeast_m = 0.1;
  for (std::size_t j = 0; j < torque_use_sum_.size() && walk_ticks_ > 0; ++j) {
    out.torque_use.push_back(
        {torque_use_sum_[j] / static_cast<double>(walk_ticks_), torque_use_peak_[j]});
  }
  out.supply_energy_j = supply_energy_j_;
  out.joint_work_j = joint_work_j_;
  const double carried_n_m = last_.weight_n * out.distance_m;
  if (out.distance_m < kLeast_m || carried_n_m <= 0) return;
  // Without a stall current the cost is unknown, not zero.
  if (supply_energy_j_ > 0) out.cost_of_transport = supply_energy_j_ / carried_n_m;
  out.cost_of_transport_mechanical = joint_work_j_ / carried_n_m;
}

void WalkMeter::begin_walk(const Truth& truth) {
  last_mark_m_ = here_m_;
  slid_m_.setZero();
  pending_.clear();
  if (ever_walked_) return;
  ever_walked_ = true;
  line_origin_m_ = here_m_;
  line_heading_rad_ = ground_heading(truth);
}

void WalkMeter::end_walk() {
  path_m_ += (here_m_ - last_mark_m_).norm();
  last_mark_m_ = here_m_;
  pending_.clear();
}

void WalkMeter::follow_path(const Truth& truth, const Outputs& outputs) {
  const Vec2 offset = here_m_ - line_origin_m_;
  ahead_m_ = std::cos(line_heading_rad_) * offset.x() + std::sin(line_heading_rad_) * offset.y();
  lateral_m_ = std::cos(line_heading_rad_) * offset.y() - std::sin(line_heading_rad_) * offset.x();
  const bool cycle_begins =
      walking_ && outputs.stance == gait::kLeft && previous_.stance != gait::kLeft;
  if (!cycle_begins) return;
  const Vec2 way_m = here_m_ - last_mark_m_;
  path_m_ += way_m.norm();
  slip_m_ += slid_m_.dot(way_m.normalized());
  last_mark_m_ = here_m_;
  slid_m_.setZero();
  marks_.push_back({truth.t_s, path_m_, slip_m_, outputs.gait_phase});
}

void WalkMeter::score_zmp(const Truth& truth, const FootLoads& loads) {
  if (!loads.valid() || truth.fallen) return;
  const Vec2 zmp = loads.zmp_world_m();
  std::array<double, 2> distance_mm{};
  for (std::size_t foot = 0; foot < 2; ++foot) {
    distance_mm[foot] = 1e3 * (zmp - truth.foot[foot].centroid_world_m.head<2>()).norm();
  }
  const int state = std::min<int>(previous_.gait_state, 15);
  if (previous_.stance == gait::kBoth) {
    pending_.push_back({state, distance_mm});
    return;
  }
  for (const Pending& past : pending_) add_bias(past.state, past.distance_mm[previous_.stance]);
  pending_.clear();
  add_bias(state, distance_mm[previous_.stance]);
}

void WalkMeter::add_bias(int state, double distance_mm) {
  bias_sum_mm_[static_cast<std::size_t>(state)] += distance_mm;
  ++bias_count_[static_cast<std::size_t>(state)];
}

void WalkMeter::score_steady(WalkMetrics& out) const {
  const int transition = static_cast<int>(gait::Phase::kTransition);
  double length_m = 0, slip_m = 0, time_s = 0;
  for (std::size_t begin = 0; begin < marks_.size();) {
    std::size_t end = begin;
    while (end < marks_.size() && marks_[end].phase == transition) ++end;
    if (end - begin > 2 * kUnsteadyCycles + 1) {
      const Mark& first = marks_[begin + kUnsteadyCycles];
      const Mark& last = marks_[end - 1 - kUnsteadyCycles];
      length_m += last.path_m - first.path_m;
      slip_m += last.slip_m - first.slip_m;
      time_s += last.t_s - first.t_s;
    }
    begin = std::max(end, begin + 1);
  }
  if (time_s <= 0) return;
  out.speed_steady_m_s = length_m / time_s;
  out.slip_steady_m_s = slip_m / time_s;
}

WalkMetrics WalkMeter::result() const {
  WalkMetrics out;
  out.duration_s = last_.truth.t_s - first_s_;
  out.walk_s = walk_s_;
  out.distance_m = path_m_ + (walking_ ? (here_m_ - last_mark_m_).norm() : 0);
  if (walk_s_ > 0) out.speed_mean_m_s = out.distance_m / walk_s_;
  score_steady(out);
  score_transport(out);
  out.ahead_m = ahead_m_;
  out.lateral_drift_m = lateral_m_;
  out.yaw_drift_deg = yaw_turned_rad_ * 180 / std::numbers::pi;
  out.fallen = last_.truth.fallen;
  out.self_contact_ticks = self_contact_ticks_;
  if (self_contact_ticks_ > 0) {
    for (std::size_t i = 0; i < 2; ++i)
      out.self_contact_links[i] = link_names_[static_cast<std::size_t>(self_contact_nodes_[i])];
  }
  double sum = 0;
  std::uint64_t count = 0;
  for (std::size_t s = 0; s < 16; ++s) {
    if (bias_count_[s] == 0) continue;
    out.zmp_bias_by_state_mm[s] = bias_sum_mm_[s] / static_cast<double>(bias_count_[s]);
    sum += bias_sum_mm_[s];
    count += bias_count_[s];
  }
  if (count > 0) out.zmp_bias_mean_mm = sum / static_cast<double>(count);
  if (walk_steps_ == 0 || walk_saturated_.empty()) return out;
  const auto worst = std::max_element(walk_saturated_.begin(), walk_saturated_.end());
  out.servo_saturation_worst_joint = static_cast<int>(worst - walk_saturated_.begin());
  out.servo_saturation_worst = static_cast<double>(*worst) / static_cast<double>(walk_steps_);
  double saturated = 0;
  for (const std::uint64_t steps : walk_saturated_) saturated += static_cast<double>(steps);
  out.servo_saturation = saturated / static_cast<double>(walk_steps_ * walk_saturated_.size());
  return out;
}

void WalkMeter::keep(const Observation& seen, const Outputs& outputs,
                     const std::optional<Vec2>& zmp_planned_world_m) {
  const Truth& truth = seen.truth;
  SeriesRow row;
  row.t_s = truth.t_s;
  row.phase = outputs.gait_phase;
  row.state = outputs.gait_state;
  row.stance = outputs.stance;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const double servo_rad = angle_of(joints_[j].servo, outputs.goal_count[j]);
    row.goal_rad.push_back(joints_[j].ratio * servo_rad + joints_[j].offset_rad);
  }
  row.joint_rad = truth.joint_rad;
  row.torque_use = truth.torque_use;
  row.body_world_m = truth.body_world.translation();
  row.body_rpy_rad = Vec3(truth.roll_rad, truth.pitch_rad, truth.yaw_rad);
  row.com_world_m = truth.com_world_m;
  for (std::size_t foot = 0; foot < 2; ++foot) {
    row.sole_world_m[foot] = truth.foot[foot].sole_world.translation();
    row.sole_rpy_rad[foot] = roll_pitch_yaw(truth.foot[foot].sole_world.linear());
    row.foot_force_n[foot] = truth.foot[foot].normal_force_n;
  }
  row.zmp_valid = seen.loads.valid();
  if (row.zmp_valid) row.zmp_world_m = seen.loads.zmp_world_m();
  row.zmp_planned_valid = zmp_planned_world_m.has_value();
  row.zmp_planned_world_m = zmp_planned_world_m.value_or(Vec2::Zero());
  row.support_world_m = truth.support_world_m;
  series_.push_back(std::move(row));
}

}  // namespace verp::sim
