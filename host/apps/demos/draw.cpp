#include "host/apps/demos/draw.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/study/report/palette.hpp"
#include "host/study/report/script.hpp"

namespace verp::demos {
namespace {

using report::kInk, report::kSoft;

struct Box {
  brain::Point low{1e9, 1e9}, high{-1e9, -1e9};
  void add(brain::Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

const char* colour(std::size_t robot) {
  return report::kSeries[robot % report::kSeriesCount].sentinel;
}

constexpr double kPoint_s = 0.25;  // between two points of a path

class Picture {
 public:
  explicit Picture(const Run& run) : run_(run) {
    for (const Outline& each : run.outlines) wall(each);
    for (std::size_t i = 0; i < run.robots.size(); ++i) robot(i);
    for (const ThingTrack& each : run.things) thing(each);
    for (const brain::Point mark : run.demo->marks) {
      report::Data data(name("mark").c_str());
      data.row(mark.x, mark.y);
      add(data, fmt::format("with points linecolor rgb '{}' pointtype 2 pointsize 2 notitle", kInk),
          "mark");
      box_.add(mark);
    }
  }

  std::string script() {
    constexpr double kAround_m = 0.4;
    std::string out = report::preamble() + data_;
    out += fmt::format(
        "set size ratio -1\nset xlabel 'x, m'\nset ylabel 'y, m'\n"
        "set xrange [{:.3f}:{:.3f}]\nset yrange [{:.3f}:{:.3f}]\nset key outside right top\n",
        box_.low.x - kAround_m, box_.high.x + kAround_m, box_.low.y - kAround_m,
        box_.high.y + kAround_m);
    return out + "plot " + plot_.substr(0, plot_.size() - 2) + "\n";
  }
  double shape() const { return (box_.high.y - box_.low.y + 1) / (box_.high.x - box_.low.x + 1); }

 private:
  std::string name(const char* kind) const { return fmt::format("{}{}", kind, blocks_); }
  void add(const report::Data& data, const std::string& how, const char* kind) {
    data_ += data.text();
    plot_ += fmt::format("${} {}, ", name(kind), how);
    ++blocks_;
  }

  void wall(const Outline& outline) {
    report::Data data(name("wall").c_str());
    for (const brain::Point at : outline.corners) {
      data.row(at.x, at.y);
      box_.add(at);
    }
    data.row(outline.corners.front().x, outline.corners.front().y);
    add(data, fmt::format("with filledcurves closed fillcolor rgb '{}' notitle", kSoft), "wall");
  }

  void robot(std::size_t i) {
    const Track& track = run_.robots[i];
    if (track.moments.empty()) return;
    report::Data real(name("real").c_str());
    double next_s = 0;
    for (const Moment& each : track.moments) {
      box_.add(each.real.at_m);
      if (each.time_s < next_s && &each != &track.moments.back()) continue;
      next_s = each.time_s + kPoint_s;
      real.row(each.real.at_m.x, each.real.at_m.y, each.believed.at_m.x, each.believed.at_m.y);
    }
    const std::string block = name("real");
    add(real,
        fmt::format("using 1:2 with lines linewidth 2 linecolor rgb '{0}' title '{1}', ${2} using "
                    "3:4 with lines dashtype 3 linecolor rgb '{0}' notitle",
                    colour(i), report::plain(track.name), block),
        "real");
    constexpr double kNose_m = 0.16;
    const brain::Pose end = track.moments.back().real;
    const brain::Point nose = kNose_m * brain::turned({1, 0}, end.yaw_rad);
    report::Data arrow(name("end").c_str());
    arrow.row(end.at_m.x, end.at_m.y, nose.x, nose.y);
    add(arrow, fmt::format("with vectors filled linewidth 2 linecolor rgb '{}' notitle", colour(i)),
        "end");
  }

  void thing(const ThingTrack& track) {
    if (track.at_m.empty()) return;
    report::Data data(name("thing").c_str());
    for (std::size_t i = 0; i < track.at_m.size(); i += 5)
      data.row(track.at_m[i].x, track.at_m[i].y);
    data.row(track.at_m.back().x, track.at_m.back().y);
    for (const brain::Point at : track.at_m) box_.add(at);
    add(data,
        fmt::format("with linespoints linecolor rgb '{}' pointtype 6 pointsize 0.7 title '{}'",
                    kInk, report::plain(track.name)),
        "thing");
  }

  const Run& run_;
  Box box_;
  std::string data_, plot_;
  int blocks_ = 0;
};

}  // namespace

report::Plot plot_of(const Run& run) {
  constexpr int kWidth = 900, kLegend = 120, kAxes = 70;
  Picture picture(run);
  report::Plot plot;
  plot.id = run.demo->name;
  plot.title = run.demo->what;
  plot.caption = "From above. Lines: where each robot was; dotted: where its odometry had it";
  plot.width = kWidth;
  plot.height =
      std::clamp(static_cast<int>((kWidth - kLegend) * picture.shape()) + kAxes, 320, 1200);
  plot.script = picture.script();
  return plot;
}

}  // namespace verp::demos
