#include "host/study/signals/table.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

#include "host/trace/record/fields.hpp"
#include "host/trace/record/ros_messages.hpp"

namespace verp::signals {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Table::Table(const record::Trace& trace, bool states)
    : trace_(trace),
      states_(states),
      columns_(columns_of(trace.params, states)),
      decisions_(trace),
      speeds_(trace.params) {}

bool Table::next() {
  if (next_ == trace_.ticks.size()) return false;
  index_ = next_++;
  read(trace_.ticks[index_]);
  return true;
}

void Table::read(const TickRecord& record) {
  const Params& params = trace_.params;
  const Inputs& in = record.inputs;
  numbers_.assign(
      {static_cast<double>(in.tick), in.tick * trace_.period_s(), static_cast<double>(in.flags)});
  const auto scaled = [&](auto count, float unit) {
    numbers_.push_back(static_cast<double>(static_cast<float>(count) * unit));
  };
  for (const auto count : in.gyro_count) scaled(count, params.imu.gyro_rad_s_per_count);
  for (const auto count : in.accel_count) scaled(count, params.imu.accel_m_s2_per_count);
  for (const auto& foot : in.foot_count) {
    for (const auto count : foot) scaled(count, params.feet.newton_per_count);
  }
  for (int j = 0; j < params.joint_count; ++j) {
    numbers_.push_back(record::ros::joint_rad(params.joint[j], in.position_count[j]));
  }
  const Outputs* made = decisions_.at(record);
  if (made == nullptr && !other_from_) other_from_ = in.tick;
  read_decisions(made);
  for (const double rad_s : speeds_.after(in)) numbers_.push_back(rad_s);
  for (int j = 0; j < params.joint_count; ++j) {
    numbers_.push_back(
        made == nullptr ? kUnknown : record::ros::joint_rad(params.joint[j], made->goal_count[j]));
  }
  read_estimates(made != nullptr ? &decisions_.state() : nullptr);
  state_.clear();
  if (states_ && made != nullptr) state_ = record::print_fields(decisions_.state());
}

void Table::read_decisions(const Outputs* made) {
  if (made == nullptr) {
    numbers_.insert(numbers_.end(), 7, kUnknown);
    return;
  }
  for (const auto value : {made->mode, made->gait_phase, made->gait_state, made->stance}) {
    numbers_.push_back(value);
  }
  numbers_.push_back(made->faults);
  for (const auto tilt : made->tilt_tenth_mrad) numbers_.push_back(1e-4 * tilt);
}

void Table::read_estimates(const State* state) {
  if (state == nullptr) {
    numbers_.insert(numbers_.end(), 14, kUnknown);
    return;
  }
  const balance::EstimatorState& seen = state->estimator;
  const Xyz com_m = math::to_xyz(balance::com_m(seen));
  const gait::Xy dcm_m = balance::dcm_m(seen);
  for (const float value : {seen.body_m.x, seen.body_m.y, seen.body_m.z, balance::roll_rad(seen),
                            balance::pitch_rad(seen), state->attitude.heading_rad, com_m.x, com_m.y,
                            com_m.z, seen.com_velocity_m_s.x, seen.com_velocity_m_s.y,
                            seen.com_velocity_m_s.z, dcm_m.x, dcm_m.y}) {
    numbers_.push_back(static_cast<double>(value));
  }
}

double Table::number(std::size_t column) const {
  if (column < numbers_.size()) return numbers_[column];
  const std::size_t field = column - numbers_.size();
  return field < state_.size() ? std::strtod(state_[field].second.c_str(), nullptr) : kUnknown;
}

void Table::append_text(std::size_t column, std::string& out) const {
  if (columns_[column].format == Format::kState) {
    if (!state_.empty()) out += state_[column - numbers_.size()].second;
    return;
  }
  const double value = numbers_[column];
  if (std::isnan(value)) return;
  const auto to = std::back_inserter(out);
  switch (columns_[column].format) {
    case Format::kWhole:
      fmt::format_to(to, "{:.0f}", value);
      break;
    case Format::kFixed4:
      fmt::format_to(to, "{:.4f}", value);
      break;
    case Format::kFixed6:
      fmt::format_to(to, "{:.6f}", value);
      break;
    case Format::kDigits5:
      fmt::format_to(to, "{:.5g}", value);
      break;
    case Format::kDigits6:
    case Format::kState:
      fmt::format_to(to, "{:.6g}", value);
      break;
  }
}

}  // namespace verp::signals
