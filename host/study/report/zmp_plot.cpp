#include "host/study/report/zmp_plot.hpp"

#include <algorithm>
#include <limits>

#include "host/study/report/palette.hpp"

namespace verp::report {
namespace {

void add_outline(const std::array<Point2, 4>& corners, Data& data) {
  for (std::size_t i = 0; i <= 4; ++i) {
    data.row(1000 * corners[i % 4].x_m, 1000 * corners[i % 4].y_m);
  }
  data.end_row().end_row();
}

/// Draws a sole in mid-stance, where the sole is flat.
bool shows_sole(const Run& run, const Range& range, std::size_t i, std::size_t foot) {
  const Sample& s = run.samples[i];
  const bool first = i == range.first || run.samples[i - 1].state != s.state;
  return first && (s.state == 4 || s.state == 11) && s.carrying == static_cast<int>(foot) &&
         s.contact[foot];
}

struct Extent {
  Point2 low{1e9, 1e9}, high{-1e9, -1e9};
  void add(const std::array<Point2, 4>& corners) {
    for (const Point2& corner : corners) {
      low.x_m = std::min(low.x_m, 1000 * corner.x_m);
      low.y_m = std::min(low.y_m, 1000 * corner.y_m);
      high.x_m = std::max(high.x_m, 1000 * corner.x_m);
      high.y_m = std::max(high.y_m, 1000 * corner.y_m);
    }
  }
  bool empty() const { return low.x_m > high.x_m; }
};

void add_zmp(const std::optional<Point2>& zmp, Data& data) {
  if (zmp) {
    data.row(1000 * zmp->x_m, 1000 * zmp->y_m);
  } else {
    data.end_row();
  }
}

}  // namespace

Panel zmp_panel(const Run& run, const Range& range) {
  Data soles[2] = {Data("left"), Data("right")};
  Data measured("measured"), planned("planned"), body("body");
  Extent extent;
  bool has_plan = false;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Sample& s = run.samples[i];
    for (std::size_t foot = 0; foot < 2; ++foot) {
      if (!shows_sole(run, range, i, foot)) continue;
      add_outline(s.sole[foot], soles[foot]);
      extent.add(s.sole[foot]);
    }
    add_zmp(s.zmp, measured);
    add_zmp(s.zmp_planned, planned);
    has_plan = has_plan || s.zmp_planned;
    body.row(1000 * s.body.x_m, 1000 * s.body.y_m);
  }
  Panel panel;
  panel.data = measured.text() + planned.text() + body.text() + soles[0].text() + soles[1].text();
  if (!extent.empty()) {
    panel.commands =
        fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", extent.low.x_m - 25,
                    extent.high.x_m + 25, extent.low.y_m - 20, extent.high.y_m + 20);
  }
  panel.commands +=
      "set size ratio -1\nset xlabel 'world x, mm'\nset ylabel 'world y, mm'\n"
      "set key outside top center horizontal\nset style fill transparent solid 0.12\n"
      "plot $left using 1:2 with filledcurves closed linetype 2 title 'left sole', "
      "$right using 1:2 with filledcurves closed linetype 3 title 'right sole', "
      "$left using 1:2 with lines linetype 2 linewidth 1 notitle, "
      "$right using 1:2 with lines linetype 3 linewidth 1 notitle, ";
  panel.commands += fmt::format(
      "$body using 1:2 with lines linecolor rgb '{}' linewidth 1.2 dashtype 2 title 'body', ",
      kInk);
  if (has_plan) {
    panel.commands +=
        "$planned using 1:2 with lines linetype 5 linewidth 2.5 title 'planned ZMP', ";
  }
  panel.commands += "$measured using 1:2 with linespoints linetype 1 title 'measured ZMP'\n";
  return panel;
}

Plot zmp_plot(const Run& run, const Range& cycle) {
  // Three cycles show the pattern.
  const std::size_t more = 2 * (cycle.last - cycle.first);
  const Panel panel = zmp_panel(run, {cycle.first - std::min(cycle.first, more), cycle.last});
  return {
      "zmp",
      "ZMP against the support polygon",
      "From above, over three cycles: the ZMP walks from sole to sole. Soles are drawn where they "
      "carry; the plan is placed by the sole that carries.",
      920,
      460,
      preamble() + panel.data + panel.commands};
}

}  // namespace verp::report
