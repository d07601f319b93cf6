#include "host/study/report/plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/study/report/csv.hpp"
#include "host/study/report/figure.hpp"
#include "host/study/report/palette.hpp"
#include "host/study/report/script.hpp"
#include "host/study/report/zmp_plot.hpp"

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

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Appended to a `plot` command; empty without a mean.
std::string mean_line(const std::optional<double>& mean, const char* title) {
  if (!mean) return "";
  return fmt::format(
      ", {0:.6g} with lines linecolor rgb '{1}' linewidth 1.2 dashtype 2 title "
      "sprintf('{2}', {0:.6g})",
      *mean, kInk, title);
}

/// A plot's extent from above, with a limited aspect ratio.
class Extent2 {
 public:
  void add(const Point2& point) {
    low_.x_m = std::min(low_.x_m, point.x_m), high_.x_m = std::max(high_.x_m, point.x_m);
    low_.y_m = std::min(low_.y_m, point.y_m), high_.y_m = std::max(high_.y_m, point.y_m);
  }
  std::string ranges() const {
    return fmt::format("set xrange [{:.4g}:{:.4g}]\nset yrange [{:.4g}:{:.4g}]\n",
                       middle_x_m() - wide_m() / 2, middle_x_m() + wide_m() / 2,
                       middle_y_m() - high_m() / 2, middle_y_m() + high_m() / 2);
  }
  int height_px() const { return static_cast<int>(780 * high_m() / wide_m() + 110); }

 private:
  double across_m() const {
    return 1.1 * std::max({high_.x_m - low_.x_m, (high_.y_m - low_.y_m) / 0.6, 0.4});
  }
  double wide_m() const { return across_m(); }
  double high_m() const { return std::max(1.1 * (high_.y_m - low_.y_m), across_m() / 4); }
  double middle_x_m() const { return (low_.x_m + high_.x_m) / 2; }
  double middle_y_m() const { return (low_.y_m + high_.y_m) / 2; }

  Point2 low_, high_;
};

Plot bias_plot(const Run& run) {
  Data data("bias");
  for (std::size_t i = 0; i < 16; ++i) data.row(i, run.bias_by_state_mm[i].value_or(kNone));
  std::string script = preamble() + data.text();
  script += fmt::format(
      "set style fill solid 0.75 noborder\nset boxwidth 0.7\nset yrange [0:*]\nset xrange "
      "[-0.7:15.7]\n"
      "set xtics 0,1,15\nset xlabel 'state of the cycle'\nset ylabel 'ZMP bias, mm'\n"
      "set key outside top center horizontal\n"
      "plot $bias using 1:2 with boxes linetype 1 notitle{}\n",
      mean_line(run.bias_mean_mm, "mean %.1f mm"));
  return {"bias",
          "ZMP bias of the 16 states",
          "Ground-plane distance from the measured ZMP to the centre of the supporting sole.",
          920,
          300,
          script};
}

Plot way_plot(const Run& run) {
  Data asked("asked"), walked("walked"), start("start");
  const std::size_t stride = std::max<std::size_t>(1, run.samples.size() / 1500);
  Extent2 seen;
  for (const Point2& point : run.asked) {
    asked.row(point.x_m, point.y_m);
    seen.add(point);
  }
  for (std::size_t i = 0; i < run.samples.size(); i += stride) {
    const Point2 body{run.samples[i].body.x_m, run.samples[i].body.y_m};
    walked.row(body.x_m, body.y_m);
    seen.add(body);
  }
  start.row(run.asked.front().x_m, run.asked.front().y_m);
  std::string script = preamble() + asked.text() + walked.text() + start.text();
  script += fmt::format(
      "set size ratio -1\nset xlabel 'ahead, m'\nset ylabel 'to the left, m'\n{}"
      "set key outside top center horizontal\n"
      "plot $asked using 1:2 with lines linecolor rgb '{}' linewidth 1.2 dashtype 2 title 'asked', "
      "$walked using 1:2 with lines linetype 1 title 'walked', "
      "$start using 1:2 with points linetype 1 pointsize 0.8 title 'start'\n",
      seen.ranges(), kInk);
  return {"way",
          "The way asked and walked",
          "From above: where the command leads from where the gait began, and where the body went.",
          920,
          seen.height_px(),
          script};
}

Plot speed_plot(const Run& run) {
  const std::vector<double> speed = speed_m_s(run);
  const std::size_t stride = std::max<std::size_t>(1, speed.size() / 1500);
  Data data("speed");
  for (std::size_t i = 0; i < speed.size(); i += stride) data.row(run.samples[i].t_s, speed[i]);
  std::string script = preamble() + data.text();
  script += fmt::format(
      "set xlabel 'time since the gait began, s'\nset ylabel 'speed, m/s'\nset yrange [0<*:*]\n"
      "set key outside top center horizontal\nset xrange [0:{:.6g}]\n"
      "plot $speed using 1:2 with lines linetype 1 title 'over one cycle'{}\n",
      run.samples.back().t_s, mean_line(run.speed_mean_m_s, "mean of all phases %.3f m/s"));
  return {"speed", "Speed", "Forward speed of the body's centre, averaged over one cycle.",
          920,     300,     script};
}

Plot torque_plot(const Run& run) {
  const std::vector<TorqueUse> use = torque_use(run);
  Data data("torque");
  for (std::size_t j = 0; j < use.size(); ++j) {
    data.cell(static_cast<double>(j)).label(plain(run.joints[j]));
    data.cell(100 * use[j].mean).cell(100 * use[j].peak).end_row();
  }
  std::string script = preamble() + data.text();
  script +=
      "set style fill solid 0.75 noborder\nset boxwidth 0.7\nset yrange [0:100<*]\n"
      "set xtics rotate by -50 noenhanced\nset ylabel 'torque use, % of stall'\n"
      "set key outside top center horizontal\nset xrange [-0.7:*]\n"
      "plot $torque using 1:3:xtic(2) with boxes linetype 1 title 'mean', "
      "$torque using 1:4 with points linetype 2 pointtype 7 pointsize 0.7 title 'peak'\n";
  return {"torque", "Torque use", "Motor torque of every joint as a share of its stall torque.",
          920,      360,          script};
}

Plot sweep_plot(const Run& run) {
  Data data("sweep");
  for (const SweepRow& row : run.sweep) {  // reached, not requested
    for (const SweepWalk& walk : {row.with, row.without}) {
      data.cell(100 * walk.step_m.value_or(row.step_m)).cell(walk.bias_mm.value_or(kNone));
    }
    data.end_row();
  }
  std::string script = preamble() + data.text();
  script +=
      "set xlabel 'step, cm'\nset ylabel 'mean ZMP bias, mm'\nset yrange [0:*]\nset offsets "
      "0.3,0.3,0,0\n"
      "set key outside top center horizontal\n"
      "plot $sweep using 3:4 with linespoints linetype 2 pointsize 0.8 title 'without multibody "
      "correction', "
      "$sweep using 1:2 with linespoints linetype 1 pointsize 0.8 title 'with'\n";
  return {"sweep",
          "ZMP bias over the step length",
          "Without the multibody correction the bias grows with the step, as in the paper.",
          920,
          320,
          script};
}

}  // namespace

std::vector<Plot> plots(const Run& run) {
  std::vector<Plot> all;
  const Range cycle = last_steady_cycle(run);
  if (!cycle.empty()) {
    if (!run.limbs.empty()) all.push_back(figure_plot(run, cycle));
    if (!run.leg_joints[0].empty() && !run.leg_joints[1].empty())
      all.push_back(joint_plot(run, cycle));
    all.push_back(key_point_plot(run, cycle));
    all.push_back(zmp_plot(run, cycle));
  }
  if (run.samples.size() > 1) {
    if (run.bias_mean_mm) all.push_back(bias_plot(run));
    if (!run.asked.empty()) all.push_back(way_plot(run));
    all.push_back(speed_plot(run));
    all.push_back(torque_plot(run));
  }
  const bool swept = std::any_of(run.sweep.begin(), run.sweep.end(), [](const SweepRow& row) {
    return row.with.bias_mm || row.without.bias_mm;
  });
  if (swept) all.push_back(sweep_plot(run));
  return all;
}

}  // namespace verp::report
