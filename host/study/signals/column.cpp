#include "host/study/signals/column.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <utility>

#include "common/control/state.hpp"
#include "host/trace/record/fields.hpp"

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

}  // namespace verp::signals
