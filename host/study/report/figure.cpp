#include "host/study/report/figure.hpp"

#include <algorithm>
#include <cmath>

#include "host/study/report/palette.hpp"
#include "host/study/report/script.hpp"
#include "host/study/report/zmp_plot.hpp"

namespace verp::report {
namespace {

constexpr int kStates = 16;
constexpr int kIntervals = kStates - 1;
constexpr double kGap_mm = 12;  // between two figures

using Kind = Limb::Kind;

/// A head's line ends at its centre.
double head_radius_mm(const std::vector<Point3>& line) {
  const Point3 &neck = line[line.size() - 2], &centre = line.back();
  return 800 * std::hypot(centre.x_m - neck.x_m, centre.z_m - neck.z_m);
}

/// The states from the side: way from the cycle's first body pose, and height.
class Strip {
 public:
  Strip(const Run& run, const Range& cycle) : run_(run), first_(run.samples[cycle.first]) {
    const std::size_t last = std::min(cycle.last, run.samples.size() - 1);
    for (int state = 0; state < kStates; ++state) {
      const double share = static_cast<double>(state) / kIntervals;
      const double along = static_cast<double>(last - cycle.first) * share;
      states_.push_back(&run.samples[cycle.first + static_cast<std::size_t>(std::lround(along))]);
    }
    for (const Sample* state : states_) {
      for (std::size_t limb = 0; limb < run.limbs.size(); ++limb) {
        const auto& line = state->limb[limb];
        for (const Point3& point : line) measure(*state, point);
        if (run.limbs[limb].kind == Kind::kHead) {
          height_mm_ = std::max(height_mm_, 1000 * line.back().z_m + head_radius_mm(line));
        }
      }
    }
  }
  double pitch_mm() const { return back_mm_ + front_mm_ + kGap_mm; }
  double height_mm() const { return height_mm_; }
  double left_mm() const { return -back_mm_; }
  double right_mm() const { return kIntervals * pitch_mm() + front_mm_; }
  const Sample& state(int i) const { return *states_[static_cast<std::size_t>(i)]; }

  double x_mm(int i, const Point3& point) const {
    return i * pitch_mm() + 1000 * (ahead_m(point) - ahead_m(state(i).body));
  }
  double x_mm(int i, const Point2& point) const { return x_mm(i, Point3{point.x_m, point.y_m, 0}); }

  /// Lines of one kind and side in all states, as a gnuplot data block.
  std::string lines(const char* name, Kind kind, int side) const {
    Data data(name);
    for (int i = 0; i < kStates; ++i) {
      for (std::size_t limb = 0; limb < run_.limbs.size(); ++limb) {
        if (run_.limbs[limb].kind != kind || run_.limbs[limb].side != side) continue;
        for (const Point3& point : state(i).limb[limb]) data.row(x_mm(i, point), 1000 * point.z_m);
        data.end_row();
      }
    }
    return data.text();
  }

 private:
  double ahead_m(const Point3& point) const {
    const double yaw_rad = first_.roll_pitch_yaw_rad[2];
    return (point.x_m - first_.body.x_m) * std::cos(yaw_rad) +
           (point.y_m - first_.body.y_m) * std::sin(yaw_rad);
  }
  void measure(const Sample& state, const Point3& point) {
    const double ahead_mm = 1000 * (ahead_m(point) - ahead_m(state.body));
    back_mm_ = std::max(back_mm_, -ahead_mm);
    front_mm_ = std::max(front_mm_, ahead_mm);
    height_mm_ = std::max(height_mm_, 1000 * point.z_m);
  }

  const Run& run_;
  const Sample& first_;
  std::vector<const Sample*> states_;
  double back_mm_ = 0, front_mm_ = 0, height_mm_ = 0;
};

std::string heads(const Run& run, const Strip& strip) {
  Data data("heads");
  for (int i = 0; i < kStates; ++i) {
    for (std::size_t limb = 0; limb < run.limbs.size(); ++limb) {
      if (run.limbs[limb].kind != Kind::kHead) continue;
      const auto& line = strip.state(i).limb[limb];
      data.row(strip.x_mm(i, line.back()), 1000 * line.back().z_m, head_radius_mm(line));
    }
  }
  return data.text();
}

std::string zmps(const Strip& strip) {
  Data data("reaction");
  for (int i = 0; i < kStates; ++i) {
    if (strip.state(i).zmp) data.row(strip.x_mm(i, *strip.state(i).zmp), -14);
  }
  return data.text();
}

Panel figure_panel(const Run& run, const Range& cycle) {
  const Strip strip(run, cycle);
  Panel panel;
  panel.data = strip.lines("far_arm", Kind::kArm, 0) + strip.lines("far_leg", Kind::kLeg, 0) +
               strip.lines("trunk", Kind::kTrunk, 2) + strip.lines("neck", Kind::kHead, 2) +
               strip.lines("near_leg", Kind::kLeg, 1) + strip.lines("near_arm", Kind::kArm, 1) +
               heads(run, strip) + zmps(strip);
  panel.commands = fmt::format(
      "set xrange [{:.6g}:{:.6g}]\nset yrange [-30:{:.6g}]\nset size ratio -1\n"
      "unset border\nunset ytics\nunset ylabel\nunset grid\n"
      "set xlabel 'state of the cycle, {:.3g} ms apart'\n"
      "set key outside top center horizontal\n"
      "set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead linecolor rgb '{}' linewidth "
      "1.2 back\nset xtics scale 0 (",
      strip.left_mm() - 10, strip.right_mm() + 10, strip.height_mm() + 10,
      1000 * run.cycle_s / kIntervals, kSoft);
  for (int i = 0; i < kStates; ++i) {
    panel.commands += fmt::format("{}'{}' {:.6g}", i == 0 ? "" : ", ", i, i * strip.pitch_mm());
  }
  panel.commands += fmt::format(
      ")\nplot $far_arm using 1:2 with lines linetype 6 linewidth 1.5 notitle, "
      "$far_leg using 1:2 with lines linetype 2 linewidth 3 title 'left leg', "
      "$neck using 1:2 with lines linecolor rgb '{0}' linewidth 2 notitle, "
      "$trunk using 1:2 with lines linecolor rgb '{0}' linewidth 4.5 title 'trunk', "
      "$heads using 1:2:3 with circles linecolor rgb '{0}' linewidth 2 notitle, "
      "$near_leg using 1:2 with lines linetype 3 linewidth 3 title 'right leg', "
      "$near_arm using 1:2 with lines linetype 6 linewidth 2 title 'arms', "
      "$reaction using 1:2 with points linetype 1 pointtype 9 pointsize 0.7 title 'measured ZMP'\n",
      kInk);
  return panel;
}

}  // namespace

Plot figure_plot(const Run& run, const Range& cycle) {
  const Panel panel = figure_panel(run, cycle);
  return {"figure",
          "One cycle, seen from the right",
          "The robot in the paper's 16 states, as it stood in the twin. The figures are set apart; "
          "from the first to the last it goes two steps.",
          920,
          270,
          preamble() + panel.data + panel.commands};
}

std::optional<Plot> poster(const Run& run) {
  const Range cycle = last_steady_cycle(run);
  if (cycle.empty() || run.limbs.empty()) return std::nullopt;
  const std::size_t more = 5 * (cycle.last - cycle.first);
  const Panel above = figure_panel(run, cycle);
  const Panel below = zmp_panel(run, {cycle.first - std::min(cycle.first, more), cycle.last});
  const std::string script =
      preamble() + above.data + below.data +
      "set multiplot\nset origin 0,0.5\nset size 1,0.5\nset lmargin 2\nset rmargin 2\n" +
      above.commands + "unset arrow\nset xtics autofreq\nset ytics\n" + preamble() +
      "set lmargin 8\nset rmargin 2\nset origin 0,0\nset size 1,0.5\n" + below.commands +
      "unset multiplot\n";
  return Plot{"walk", "", "", 920, 600, script};
}

}  // namespace verp::report
