#include "host/study/report/cycle_plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/study/report/script.hpp"

namespace verp::report {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// "l_knee" and "left_knee" give "knee".
std::string without_side(const std::string& name) {
  for (const char* prefix : {"l_", "r_", "left_", "right_"}) {
    if (name.starts_with(prefix)) return plain(name.substr(std::string(prefix).size()));
  }
  return plain(name);
}

/// Positions relative to the cycle's first body pose, mm: forward, left, height above each one's
/// lowest point.
class CycleFrame {
 public:
  CycleFrame(const Run& run, const Range& cycle) : origin_(run.samples[cycle.first]) {
    for (std::size_t i = cycle.first; i < cycle.last; ++i) {
      const std::array<Point3, 3> points = points_of(run.samples[i]);
      for (std::size_t p = 0; p < 3; ++p) lowest_m_[p] = std::min(lowest_m_[p], points[p].z_m);
    }
  }
  void add_row(const Sample& s, Data& data) const {
    data.cell(1000 * (s.t_s - origin_.t_s));
    const double yaw_rad = origin_.roll_pitch_yaw_rad[2];
    const std::array<Point3, 3> points = points_of(s);
    for (std::size_t p = 0; p < 3; ++p) {
      const double dx_m = points[p].x_m - origin_.body.x_m, dy_m = points[p].y_m - origin_.body.y_m;
      data.cell(1000 * (dx_m * std::cos(yaw_rad) + dy_m * std::sin(yaw_rad)));
      data.cell(1000 * (dy_m * std::cos(yaw_rad) - dx_m * std::sin(yaw_rad)));
      data.cell(1000 * (points[p].z_m - lowest_m_[p]));
    }
    data.end_row();
  }

 private:
  static std::array<Point3, 3> points_of(const Sample& s) {
    return {s.body, s.ankle[0], s.ankle[1]};
  }
  const Sample& origin_;
  std::array<double, 3> lowest_m_{1e9, 1e9, 1e9};
};

}  // namespace

Plot joint_plot(const Run& run, const Range& cycle) {
  Data data("angles");
  const double start_s = run.samples[cycle.first].t_s;
  for (std::size_t i = cycle.first; i < cycle.last; ++i) {
    const Sample& s = run.samples[i];
    data.cell(1000 * (s.t_s - start_s));
    for (const double rad : s.joint_rad) data.cell(rad * kDegrees);
    data.end_row();
  }
  std::string script = preamble() + data.text();
  script += fmt::format(
      "set multiplot layout 1,2\nset xrange [0:{:.6g}]\nset xlabel 'time in the cycle, ms'\n"
      "set key below horizontal maxcols 3\nset bmargin 7\n",
      1000 * run.cycle_s);
  const char* sides[2] = {"left leg", "right leg"};
  for (std::size_t side = 0; side < 2; ++side) {
    script += fmt::format("set title '{}'\nset ylabel '{}'\nplot ", sides[side],
                          side == 0 ? "joint angle, degrees" : "");
    const char* separator = "";
    for (std::size_t i = 0; i < run.leg_joints[side].size(); ++i) {
      const auto joint = static_cast<std::size_t>(run.leg_joints[side][i]);
      script += fmt::format("{}$angles using 1:{} with lines linetype {} title '{}'", separator,
                            joint + 2, i % 6 + 1, without_side(run.joints[joint]));
      separator = ", ";
    }
    script += '\n';
  }
  return {"joints",
          "Joint angles of one cycle",
          run.steady ? "Measured in the twin over the last steady cycle; the right leg repeats the "
                       "left half a cycle later."
                     : "Measured in the twin over the last whole cycle. The walk was too short to "
                       "become steady: the legs need not repeat each other.",
          920,
          450,
          script + "unset multiplot\n"};
}

Plot key_point_plot(const Run& run, const Range& cycle) {
  Data path("path"), keys("keys");
  const CycleFrame frame(run, cycle);
  for (std::size_t i = cycle.first; i < cycle.last; ++i) {
    frame.add_row(run.samples[i], path);
    const bool key = i == cycle.first || run.samples[i].state != run.samples[i - 1].state;
    if (key) frame.add_row(run.samples[i], keys);
  }
  std::string script = preamble() + path.text() + keys.text();
  script += fmt::format("set multiplot layout 3,1\nset xrange [0:{:.6g}]\nset lmargin 10\n",
                        1000 * run.cycle_s);
  const char* axes[3] = {"forward, mm", "to the left, mm", "above lowest, mm"};
  const char* names[3] = {"body", "left ankle", "right ankle"};
  for (int axis = 0; axis < 3; ++axis) {
    script += fmt::format("set ylabel '{}'\n{}\n{}\nplot ", axes[axis],
                          axis == 0 ? "set key outside top center horizontal" : "unset key",
                          axis == 2 ? "set xlabel 'time in the cycle, ms'" : "unset xlabel");
    for (int point = 0; point < 3; ++point) {
      const int column = 2 + 3 * point + axis;
      script += fmt::format(
          "{0}$path using 1:{1} with lines linetype {2} title '{3}', "
          "$keys using 1:{1} with points linetype {2} pointsize 0.6 notitle",
          point == 0 ? "" : ", ", column, point + 1, names[point]);
    }
    script += '\n';
  }
  return {"keypoints",
          "Body and ankle key points",
          "The body's centre and both ankles over one cycle; dots mark the paper's states. Heights "
          "count from each "
          "point's lowest.",
          920,
          620,
          script + "unset multiplot\n"};
}

}  // namespace verp::report
