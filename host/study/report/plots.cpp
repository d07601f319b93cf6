#include "host/study/report/plots.hpp"

#include <algorithm>
#include <limits>

#include "host/study/report/csv.hpp"
#include "host/study/report/cycle_plots.hpp"
#include "host/study/report/figure.hpp"
#include "host/study/report/palette.hpp"
#include "host/study/report/script.hpp"
#include "host/study/report/zmp_plot.hpp"

namespace verp::report {
namespace {

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
