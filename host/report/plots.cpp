#include "host/report/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

namespace verp::report {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// Terminal and look shared by all pictures.
std::string preamble(int width, int height) {
  std::string text = fmt::format(
      "set terminal svg size {},{} dynamic enhanced font 'sans-serif,13'\n"
      "set border 3 linecolor rgb '{}' linewidth 1\n"
      "set tics nomirror textcolor rgb '{}' scale 0.5\n"
      "set grid linecolor rgb '{}' linewidth 0.6 dashtype solid\n"
      "set xlabel textcolor rgb '{}'\nset ylabel textcolor rgb '{}'\nset title textcolor rgb '{}'\n"
      "set key textcolor rgb '{}' samplen 1.5 spacing 1.1 noenhanced Left reverse\n",
      width, height, kSoft, kInk, kSoft, kInk, kInk, kInk, kInk);
  for (int i = 0; i < 6; ++i) {
    text +=
        fmt::format("set linetype {} linecolor rgb '{}' linewidth 1.8 pointtype 7 pointsize 0.35\n",
                    i + 1, kSeries[i]);
  }
  return text;
}

/// A named data block; rows of numbers, NaN where there is none.
class Data {
 public:
  explicit Data(const char* name) { text_ = fmt::format("${} << EOD\n", name); }
  template <class... Numbers>
  Data& row(Numbers... values) {
    ((text_ += fmt::format("{:.6g} ", static_cast<double>(values))), ...);
    text_ += '\n';
    return *this;
  }
  Data& cell(double value) {
    text_ += fmt::format("{:.6g} ", value);
    return *this;
  }
  Data& label(const std::string& value) {
    text_ += '"' + value + "\" ";
    return *this;
  }
  Data& end_row() {
    text_ += '\n';
    return *this;
  }
  std::string text() const { return text_ + "EOD\n"; }

 private:
  std::string text_;
};

/// Joint names come from a file: keep what gnuplot takes as plain text inside quotes.
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-') out += c;
  }
  return out;
}

/// "l_knee" and "left_knee" are both "knee" in a picture that has one panel a side.
std::string without_side(const std::string& name) {
  for (const char* prefix : {"l_", "r_", "left_", "right_"}) {
    if (name.starts_with(prefix)) return plain(name.substr(std::string(prefix).size()));
  }
  return plain(name);
}

Plot joint_plot(const Run& run, const Range& cycle) {
  Data data("angles");
  const double start_s = run.samples[cycle.first].t_s;
  for (std::size_t i = cycle.first; i < cycle.last; ++i) {
    const Sample& s = run.samples[i];
    data.cell(1000 * (s.t_s - start_s));
    for (const double rad : s.joint_rad) data.cell(rad * kDegrees);
    data.end_row();
  }
  std::string script = preamble(920, 450) + data.text();
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
  return {"joints", "Joint angles of one cycle",
          "Measured in the twin over the last steady cycle; the right leg repeats the left half a "
          "cycle later.",
          script + "unset multiplot\n"};
}

/// Body and both ankles as the cycle's first body pose sees them: forward, left, and height above
/// each one's lowest point in the cycle, all in mm.
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

Plot key_point_plot(const Run& run, const Range& cycle) {
  Data path("path"), keys("keys");
  const CycleFrame frame(run, cycle);
  for (std::size_t i = cycle.first; i < cycle.last; ++i) {
    frame.add_row(run.samples[i], path);
    const bool key = i == cycle.first || run.samples[i].state != run.samples[i - 1].state;
    if (key) frame.add_row(run.samples[i], keys);
  }
  std::string script = preamble(920, 620) + path.text() + keys.text();
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
  return {"keypoints", "Body and ankle key points",
          "The body's centre and both ankles over one cycle; dots mark the paper's states. Heights "
          "count from each "
          "point's lowest.",
          script + "unset multiplot\n"};
}

/// The cycle and a half before its end: enough soles to see the pattern, few enough to tell them
/// apart.
Range around(const Run& run, const Range& cycle) {
  const std::size_t length = cycle.last - cycle.first;
  return {cycle.first > length ? cycle.first - length : 0,
          std::min(cycle.last, run.samples.size())};
}

std::string closed_outline(const std::array<Point2, 4>& corners) {
  std::string text;
  for (std::size_t i = 0; i <= 4; ++i) {
    text += fmt::format("{:.6g} {:.6g}\n", 1000 * corners[i % 4].x_m, 1000 * corners[i % 4].y_m);
  }
  return text + "\n\n";
}

Plot zmp_plot(const Run& run, const Range& cycle) {
  const Range range = around(run, cycle);
  std::string soles[2] = {"$left << EOD\n", "$right << EOD\n"};
  Data zmp("zmp"), body("body");
  double low_mm = std::numeric_limits<double>::max(), high_mm = -low_mm;
  double left_mm = low_mm, right_mm = -low_mm;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Sample& s = run.samples[i];
    for (std::size_t foot = 0; foot < 2; ++foot) {
      // One outline a stance: in the middle of it, when the sole lies flat.
      const bool stands = s.carrying == static_cast<int>(foot) && s.contact[foot];
      const bool middle = s.state == (foot == 0 ? 4 : 11) || s.state == (foot == 0 ? 11 : 4);
      const bool first = i == range.first || run.samples[i - 1].state != s.state;
      if (!stands || !middle || !first) continue;
      soles[foot] += closed_outline(s.sole[foot]);
      for (const Point2& corner : s.sole[foot]) {
        low_mm = std::min(low_mm, 1000 * corner.y_m),
        high_mm = std::max(high_mm, 1000 * corner.y_m);
        left_mm = std::min(left_mm, 1000 * corner.x_m),
        right_mm = std::max(right_mm, 1000 * corner.x_m);
      }
    }
    if (s.zmp) zmp.row(1000 * s.zmp->x_m, 1000 * s.zmp->y_m);
    body.row(1000 * s.body.x_m, 1000 * s.body.y_m);
  }
  std::string script = preamble(920, 460) + zmp.text() + body.text();
  for (std::string& sole : soles) script += sole + "EOD\n";
  if (low_mm < high_mm) {
    script += fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", left_mm - 25,
                          right_mm + 25, low_mm - 20, high_mm + 20);
  }
  script += fmt::format(
      "set size ratio -1\nset xlabel 'world x, mm'\nset ylabel 'world y, mm'\n"
      "set key outside top center horizontal\nset style fill transparent solid 0.12\n"
      "plot $left using 1:2 with filledcurves closed linetype 2 title 'left sole', "
      "$right using 1:2 with filledcurves closed linetype 3 title 'right sole', "
      "$left using 1:2 with lines linetype 2 linewidth 1 notitle, "
      "$right using 1:2 with lines linetype 3 linewidth 1 notitle, "
      "$body using 1:2 with lines linecolor rgb '{}' linewidth 1.2 dashtype 2 title 'body', "
      "$zmp using 1:2 with linespoints linetype 1 title 'measured ZMP'\n",
      kInk);
  return {"zmp", "ZMP against the support polygon",
          "From above, over two cycles: the measured ZMP walks from sole to sole. Soles are drawn "
          "where they carry.",
          script};
}

Plot bias_plot(const Run& run) {
  Data data("bias");
  for (std::size_t i = 0; i < 16; ++i) data.row(i, run.bias_by_state_mm[i]);
  std::string script = preamble(920, 300) + data.text();
  script += fmt::format(
      "set style fill solid 0.75 noborder\nset boxwidth 0.7\nset yrange [0:*]\nset xrange "
      "[-0.7:15.7]\n"
      "set xtics 0,1,15\nset xlabel 'state of the cycle'\nset ylabel 'ZMP bias, mm'\n"
      "set key outside top center horizontal\nmean = {:.6g}\n"
      "plot $bias using 1:2 with boxes linetype 1 notitle, mean with lines linecolor rgb '{}' "
      "linewidth 1.2 dashtype 2 title sprintf('mean %.1f mm', mean)\n",
      run.bias_mean_mm, kInk);
  return {"bias", "ZMP bias of the 16 states",
          "Ground-plane distance from the measured ZMP to the centre of the supporting sole.",
          script};
}

Plot speed_plot(const Run& run) {
  const std::vector<double> speed = speed_m_s(run);
  const std::size_t stride = std::max<std::size_t>(1, speed.size() / 1500);
  Data data("speed");
  for (std::size_t i = 0; i < speed.size(); i += stride) data.row(run.samples[i].t_s, speed[i]);
  std::string script = preamble(920, 300) + data.text();
  script += fmt::format(
      "set xlabel 'time since the gait began, s'\nset ylabel 'speed, m/s'\nset yrange [0<*:*]\n"
      "set key outside top center horizontal\nset xrange [0:{:.6g}]\nmean = {:.6g}\n"
      "plot $speed using 1:2 with lines linetype 1 title 'over one cycle', mean with lines "
      "linecolor rgb '{}' linewidth 1.2 dashtype 2 title sprintf('mean of all phases %.3f m/s', "
      "mean)\n",
      run.samples.back().t_s, run.speed_mean_m_s, kInk);
  return {"speed", "Speed", "Forward speed of the body's centre, averaged over one cycle.", script};
}

Plot torque_plot(const Run& run) {
  const std::vector<TorqueUse> use = torque_use(run);
  Data data("torque");
  for (std::size_t j = 0; j < use.size(); ++j) {
    data.cell(static_cast<double>(j)).label(plain(run.joints[j]));
    data.cell(100 * use[j].mean).cell(100 * use[j].peak).end_row();
  }
  std::string script = preamble(920, 360) + data.text();
  script +=
      "set style fill solid 0.75 noborder\nset boxwidth 0.7\nset yrange [0:100<*]\n"
      "set xtics rotate by -50 noenhanced\nset ylabel 'torque use, % of stall'\n"
      "set key outside top center horizontal\nset xrange [-0.7:*]\n"
      "plot $torque using 1:3:xtic(2) with boxes linetype 1 title 'mean', "
      "$torque using 1:4 with points linetype 2 pointtype 7 pointsize 0.7 title 'peak'\n";
  return {"torque", "Torque use", "Motor torque of every joint as a share of its stall torque.",
          script};
}

Plot sweep_plot(const Run& run) {
  Data data("sweep");
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const SweepRow& row : run.sweep) {
    data.row(100 * row.step_m, row.fallen ? none : row.bias_mm,
             row.fallen_plain ? none : row.bias_plain_mm);
  }
  std::string script = preamble(920, 320) + data.text();
  script +=
      "set xlabel 'step, cm'\nset ylabel 'mean ZMP bias, mm'\nset yrange [0:*]\nset offsets "
      "0.3,0.3,0,0\n"
      "set key outside top center horizontal\n"
      "plot $sweep using 1:3 with linespoints linetype 2 pointsize 0.8 title 'without multibody "
      "correction', "
      "$sweep using 1:2 with linespoints linetype 1 pointsize 0.8 title 'with'\n";
  return {"sweep", "ZMP bias over the step length",
          "Without the multibody correction the bias grows with the step, as in the paper.",
          script};
}

}  // namespace

std::vector<Plot> plots(const Run& run) {
  std::vector<Plot> all;
  const Range cycle = last_steady_cycle(run);
  if (!cycle.empty()) {
    if (!run.leg_joints[0].empty() && !run.leg_joints[1].empty())
      all.push_back(joint_plot(run, cycle));
    all.push_back(key_point_plot(run, cycle));
    all.push_back(zmp_plot(run, cycle));
  }
  if (run.samples.size() > 1) {
    all.push_back(bias_plot(run));
    all.push_back(speed_plot(run));
    all.push_back(torque_plot(run));
  }
  if (!run.sweep.empty()) all.push_back(sweep_plot(run));
  return all;
}

}  // namespace verp::report
