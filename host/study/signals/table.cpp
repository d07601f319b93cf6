#include "host/study/signals/table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "common/control/state.hpp"
#include "host/trace/record/fields.hpp"
#include "host/trace/record/ros_messages.hpp"

namespace verp::signals {
namespace {

/// Units by suffix, the longest first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kUnits{
    {{"_tenth_mm_s", "0.1 mm/s"},
     {"_tenth_mrad", "0.1 mrad"},
     {"_mrad_s", "mrad/s"},
     {"_mrad", "mrad"},
     {"_rad_s", "rad/s"},
     {"_rad", "rad"},
     {"_m_s2", "m/s²"},
     {"_m_s", "m/s"},
     {"_n_m", "N m"},
     {"_m", "m"},
     {"_us", "µs"},
     {"_s", "s"}}};

/// "limit.goal_rad[3]" gives "rad".
std::string unit_of_field(std::string_view path) {
  std::string_view name = path.substr(path.rfind('.') + 1);  // npos + 1 is 0
  name = name.substr(0, name.find('['));
  for (const auto& [end, unit] : kUnits) {
    if (name.ends_with(end)) return std::string(unit);
  }
  return "";
}

std::string joint_name(const JointParams& joint) {
  return {joint.name, ::strnlen(joint.name, kNameLength)};
}

bool fits(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, from = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++, from = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p, ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1, n = ++from;  // one more character
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<Column> columns_of(const Params& params, bool states) {
  std::vector<Column> all;
  const auto add = [&](const std::string& name, const char* unit, Format format,
                       const std::string& subject = {}) {
    all.push_back({name, unit, subject.empty() ? name : subject, format});
  };
  const auto add_joints = [&](const char* what, const char* unit, Format format) {
    for (int j = 0; j < params.joint_count; ++j) {
      const std::string joint = joint_name(params.joint[j]);
      add(std::string(what) + "." + joint, unit, format, joint);
    }
  };
  add("tick", "", Format::kWhole);
  add("time_s", "s", Format::kFixed6);
  add("flags", "", Format::kWhole);
  for (const char* axis : {"x", "y", "z"}) {
    add(std::string("gyro_imu_rad_s.") + axis, "rad/s", Format::kDigits6);
  }
  for (const char* axis : {"x", "y", "z"}) {
    add(std::string("accel_imu_m_s2.") + axis, "m/s²", Format::kDigits6);
  }
  for (const char* foot : {"left", "right"}) {
    for (int i = 0; i < kFootSensors; ++i) {
      add("foot_n." + (foot + std::to_string(i)), "N", Format::kDigits6);
    }
  }
  add_joints("rad", "rad", Format::kFixed6);
  for (const char* name : {"mode", "gait_phase", "gait_state", "stance", "faults"}) {
    add(name, "", Format::kWhole);
  }
  for (const char* name : {"roll_rad", "pitch_rad"}) add(name, "rad", Format::kFixed4);
  add_joints("rad_s", "rad/s", Format::kDigits5);
  add_joints("goal_rad", "rad", Format::kFixed6);
  const auto add_axes = [&](const char* what, const char* unit, int axes) {
    for (int i = 0; i < axes; ++i)
      add(fmt::format("{}.{}", what, "xyz"[i]), unit, Format::kDigits6, what);
  };
  add_axes("body_m", "m", 3);
  for (const char* name : {"body_roll_rad", "body_pitch_rad", "body_yaw_rad"})
    add(name, "rad", Format::kDigits6);
  add_axes("com_m", "m", 3);
  add_axes("com_velocity_m_s", "m/s", 3);
  add_axes("dcm_m", "m", 2);
  if (!states) return all;
  for (const auto& [path, ignored] : record::print_fields(State{})) {
    add("state." + path, unit_of_field(path).c_str(), Format::kState);
  }
  return all;
}

std::vector<std::size_t> matching(const std::vector<Column>& columns, std::string_view pattern) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == pattern) return {i};
    if (fits(pattern, columns[i].name)) found.push_back(i);
  }
  return found;
}

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
