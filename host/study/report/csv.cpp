#include "host/study/report/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/os/files/csv_field.hpp"

namespace verp::report {
namespace {

using files::csv_field;

constexpr int kTransition = 2;  // the paper's steady phase

std::string number(double value) {
  return fmt::format(",{:.6g}", value);
}

/// Empty without a value.
std::string number(const std::optional<double>& value, int decimals) {
  return value ? fmt::format(",{:.{}f}", *value, decimals) : ",";
}

}  // namespace

std::string samples_csv(const Run& run) {
  std::string out =
      "t_s,phase,state,carrying,body_x_m,body_y_m,body_z_m,roll_rad,pitch_rad,yaw_rad";
  for (const char* foot : {"left", "right"}) {
    out += fmt::format(",{0}_ankle_x_m,{0}_ankle_y_m,{0}_ankle_z_m,{0}_contact", foot);
  }
  out += ",zmp_x_m,zmp_y_m,zmp_planned_x_m,zmp_planned_y_m,zmp_bias_mm";
  for (const std::string& joint : run.joints) out += "," + csv_field(joint + "_rad");
  for (const std::string& joint : run.joints) out += "," + csv_field(joint + "_goal_rad");
  for (const std::string& joint : run.joints) out += "," + csv_field(joint + "_torque_use");
  out += '\n';
  for (const Sample& s : run.samples) {
    out += fmt::format("{:.4f},{},{},{}", s.t_s, s.phase, s.state, s.carrying);
    for (const double v : {s.body.x_m, s.body.y_m, s.body.z_m}) out += number(v);
    for (const double v : s.roll_pitch_yaw_rad) out += number(v);
    for (std::size_t foot = 0; foot < 2; ++foot) {
      const Point3& a = s.ankle[foot];
      for (const double v : {a.x_m, a.y_m, a.z_m}) out += number(v);
      out += s.contact[foot] ? ",1" : ",0";
    }
    for (const std::optional<Point2>& zmp : {s.zmp, s.zmp_planned}) {
      out += zmp ? number(zmp->x_m) + number(zmp->y_m) : ",,";
    }
    out += s.zmp_bias_mm ? number(*s.zmp_bias_mm) : ",";
    for (const double v : s.joint_rad) out += number(v);
    for (const double v : s.goal_rad) out += number(v);
    for (const double v : s.torque_use) out += number(v);
    out += '\n';
  }
  return out;
}

std::string asked_csv(const Run& run) {
  std::string out = "x_m,y_m\n";
  for (const Point2& point : run.asked) out += fmt::format("{:.4f},{:.4f}\n", point.x_m, point.y_m);
  return out;
}

std::string bias_csv(const Run& run) {
  std::string out = "state,zmp_bias_mm\n";
  for (std::size_t i = 0; i < run.bias_by_state_mm.size(); ++i) {
    out += fmt::format("{}{}\n", i, number(run.bias_by_state_mm[i], 3));
  }
  return out;
}

std::string torque_csv(const Run& run) {
  const std::vector<TorqueUse> use = torque_use(run);
  std::string out = "joint,mean_torque_use,peak_torque_use\n";
  for (std::size_t j = 0; j < use.size(); ++j) {
    out += fmt::format("{},{:.4f},{:.4f}\n", csv_field(run.joints[j]), use[j].mean, use[j].peak);
  }
  return out;
}

std::string sweep_csv(const Run& run) {
  std::string out =
      "step_m,speed_m_s,zmp_bias_mm,zmp_bias_without_multibody_mm,fallen,fallen_without,"
      "walked_step_m,walked_step_without_m,end,end_without\n";
  for (const SweepRow& row : run.sweep) {
    const auto fell = [](const SweepWalk& walk) { return walk.end == SweepWalk::End::kFell; };
    out +=
        fmt::format("{:.4f}{}{}{},{:d},{:d}{}{},{},{}\n", row.step_m, number(row.with.speed_m_s, 4),
                    number(row.with.bias_mm, 3), number(row.without.bias_mm, 3), fell(row.with),
                    fell(row.without), number(row.with.step_m, 4), number(row.without.step_m, 4),
                    name_of(row.with.end), name_of(row.without.end));
  }
  return out;
}

std::vector<TorqueUse> torque_use(const Run& run) {
  std::vector<TorqueUse> use(run.joints.size());
  for (const Sample& s : run.samples) {
    for (std::size_t j = 0; j < std::min(use.size(), s.torque_use.size()); ++j) {
      use[j].mean += s.torque_use[j] / static_cast<double>(run.samples.size());
      use[j].peak = std::max(use[j].peak, s.torque_use[j]);
    }
  }
  return use;
}

std::vector<double> speed_m_s(const Run& run) {
  const std::size_t count = run.samples.size();
  const auto half = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(0.5 * run.cycle_s / run.period_s)));
  std::vector<double> speed(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t a = i > half ? i - half : 0, b = std::min(i + half, count - 1);
    if (a == b) continue;
    const Point3 &from = run.samples[a].body, &to = run.samples[b].body;
    const double yaw_rad = run.samples[i].roll_pitch_yaw_rad[2];
    const double ahead_m =
        (to.x_m - from.x_m) * std::cos(yaw_rad) + (to.y_m - from.y_m) * std::sin(yaw_rad);
    speed[i] = ahead_m / (run.samples[b].t_s - run.samples[a].t_s);
  }
  return speed;
}

Range last_steady_cycle(const Run& run) {
  const auto& s = run.samples;
  std::vector<std::size_t> starts;  // where state 15 wraps to 0 in steady walking
  for (std::size_t i = 1; i < s.size(); ++i) {
    if (s[i].phase == kTransition && s[i - 1].phase == kTransition && s[i].state < s[i - 1].state) {
      starts.push_back(i);
    }
  }
  // Skips the last cycles, whose strides are already shorter.
  const std::size_t keep_off = starts.size() > 16 ? 8 : 1;
  if (starts.size() < keep_off + 1) return {};
  const std::size_t at = starts.size() - keep_off - 1;
  return {starts[at], starts[at + 1]};
}

}  // namespace verp::report
