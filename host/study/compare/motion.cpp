#include "host/study/compare/motion.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "host/trace/record/decisions.hpp"
#include "host/trace/record/ros_messages.hpp"

namespace verp::compare {
namespace {

constexpr std::size_t kCycleId =
    (offsetof(Tuning, gait) + offsetof(GaitTuning, cycle_s)) / sizeof(float);

/// Interpolates linearly between the places in `known`, which ascend.
void fill(std::vector<double>& values, const std::vector<std::size_t>& known) {
  if (known.empty()) return;
  std::fill_n(values.begin(), known.front(), values[known.front()]);
  for (std::size_t k = 0; k + 1 < known.size(); ++k) {
    const std::size_t from = known[k], to = known[k + 1];
    const double slope = (values[to] - values[from]) / static_cast<double>(to - from);
    for (std::size_t i = from + 1; i < to; ++i) {
      values[i] = values[from] + slope * static_cast<double>(i - from);
    }
  }
  std::fill(values.begin() + static_cast<std::ptrdiff_t>(known.back()), values.end(),
            values[known.back()]);
}

}  // namespace

Motion::Motion(const record::Trace& trace)
    : period_s_(trace.period_s()), cycle_s_(trace.params.tuning.gait.cycle_s) {
  slots_ = slot(trace, trace.ticks.size() - 1) + 1;
  read_joints(trace);
  see_orders(trace);
}

/// The trace lacks ticks for which the PC was too late.
std::size_t Motion::slot(const record::Trace& trace, std::size_t index) const {
  return trace.ticks[index].inputs.tick - trace.ticks.front().inputs.tick;
}

void Motion::read_joints(const record::Trace& trace) {
  for (std::size_t j = 0; j < trace.params.joint_count; ++j) {
    const JointParams& joint = trace.params.joint[j];
    joints_.emplace_back(joint.name, ::strnlen(joint.name, kNameLength));
    std::vector<double>& values = rad_.emplace_back(slots_, 0.0);
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < trace.ticks.size(); ++i) {
      const Inputs& in = trace.ticks[i].inputs;
      if ((in.fresh >> j & 1U) == 0) continue;
      known.push_back(slot(trace, i));
      values[known.back()] = record::ros::joint_rad(joint, in.position_count[j]);
    }
    fill(values, known);
    read_share_.push_back(static_cast<double>(known.size()) / static_cast<double>(slots_));
  }
}

void Motion::see_orders(const record::Trace& trace) {
  record::Decisions decisions(trace);
  orders_.resize(slots_);
  std::size_t filled = 0;
  for (std::size_t i = 0; i < trace.ticks.size(); ++i) {
    const Inputs& in = trace.ticks[i].inputs;
    const double now_s = period_s_ * static_cast<double>(slot(trace, i));
    const bool walks = in.command.request == Request::kWalk;
    if ((walks || in.action != 0) && !ordered_s_) ordered_s_ = now_s;
    if (walks) walked_until_s_ = now_s;
    if ((in.flags & kParameterWrite) != 0 && in.parameter_id == kCycleId) {
      cycle_s_ = std::bit_cast<float>(in.parameter_bits);
    }
    const bool known = decisions.at(trace.ticks[i]) != nullptr;
    const State& state = decisions.state();
    const bool acts = known && (state.gait.queued > 0 || state.action.number != 0);
    if (acts && !begun_s_) begun_s_ = now_s;
    for (; filled <= slot(trace, i); ++filled) orders_[filled] = in.command;
  }
}

const Command& Motion::order(double time_s) const {
  const auto at = static_cast<std::size_t>(std::max(std::floor(time_s / period_s_ + 1e-6), 0.0));
  return orders_[std::min(at, slots_ - 1)];
}

double Motion::rad(std::size_t joint, double time_s) const {
  const double at = std::clamp(time_s / period_s_, 0.0, static_cast<double>(slots_ - 1));
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, slots_ - 1);
  const double part = at - static_cast<double>(below);
  return rad_[joint][below] + part * (rad_[joint][above] - rad_[joint][below]);
}

}  // namespace verp::compare
