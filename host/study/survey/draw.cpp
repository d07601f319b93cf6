#include "host/study/survey/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "host/study/report/palette.hpp"
#include "host/study/report/script.hpp"
#include "host/study/survey/words.hpp"

namespace verp::survey {
namespace {

using report::kInk, report::kSoft;
using End = StabilityCell::End;

constexpr double kHalfCell = 0.47;  // a gap between cells

/// One shade for each value; values are few.
std::string push_cells(const PushMap& map, const PushOptions& options,
                       const std::vector<double>& rows, std::string& plot) {
  constexpr double kLightest = 0.06, kDarkest = 0.62;  // keeps numbers legible
  std::map<double, std::vector<const PushCell*>> shades;
  double most_n_s = options.step_n_s;
  for (const PushCell& cell : map.cells) {
    if (!cell.survives_n_s) continue;
    shades[*cell.survives_n_s].push_back(&cell);
    most_n_s = std::max(most_n_s, *cell.survives_n_s);
  }
  std::string data;
  for (const auto& [impulse_n_s, cells] : shades) {
    const std::string name = fmt::format("shade{}", std::lround(impulse_n_s / options.step_n_s));
    report::Data block(name.c_str());
    for (const PushCell* cell : cells) {
      const auto row = std::find(rows.begin(), rows.end(), cell->direction_rad) - rows.begin();
      block.cell(cell->phase).cell(static_cast<double>(row));
      block.label(fmt::format("{:.1f}", impulse_n_s)).end_row();
    }
    data += block.text();
    plot += fmt::format(
        "${0} using 1:2:($1-{1}):($1+{1}):($2-{1}):($2+{1}) with boxxyerror fillstyle transparent "
        "solid {2:.2f} noborder linetype 1 notitle, ${0} using 1:2:3 with labels textcolor rgb "
        "'{3}' notitle, ",
        name, kHalfCell, kLightest + (kDarkest - kLightest) * impulse_n_s / most_n_s, kInk);
  }
  return data;
}

std::string circle(const char* name, double radius) {
  constexpr int kPoints = 90;
  report::Data data(name);
  for (int i = 0; i <= kPoints; ++i) {
    const double at_rad = 2 * std::numbers::pi * i / kPoints;
    data.row(radius * std::cos(at_rad), radius * std::sin(at_rad));
  }
  return data.text();
}

/// A closed curve by direction; ahead is up.
std::string ring(const char* name, const std::vector<Side>& sides, double Side::*value) {
  report::Data data(name);
  for (std::size_t i = 0; i <= sides.size() && !sides.empty(); ++i) {
    const Side& side = sides[i % sides.size()];
    data.row(-(side.*value) * std::sin(side.direction_rad),
             side.*value * std::cos(side.direction_rad));
  }
  return data.text();
}

struct Plane {
  const char* name;
  const char* axis;
  double Velocity::*across;
  double Velocity::*other;  ///< 0 in this plane
};
constexpr Plane kPlanes[] = {
    {"turn", "turn wz, rad/s, to the left is positive", &Velocity::wz_rad_s, &Velocity::vy_m_s},
    {"side", "sideways vy, m/s, to the left is positive", &Velocity::vy_m_s, &Velocity::wz_rad_s},
};

struct Look {
  End end;
  const char* name;
  int linetype;
  double shade;
};
constexpr Look kLooks[] = {{End::kWalked, "walked", 3, 0.30},
                           {End::kShort, "short", 5, 0.35},
                           {End::kFell, "fell", 2, 0.40},
                           {End::kFailed, "failed", 6, 0.40}};

report::Panel plane_panel(const StabilityMap& map, const StabilityOptions& options,
                          const Plane& plane) {
  const double half = options.on_axis / 2;
  const double dx = kHalfCell * options.most.*plane.across / half;
  const double dy = kHalfCell * options.most.vx_m_s / half;
  report::Panel panel;
  panel.commands = fmt::format(
      "set xlabel '{}'\nset ylabel 'ahead vx, m/s'\nset xrange [{:.5g}:{:.5g}]\n"
      "set yrange [{:.5g}:{:.5g}]\nplot ",
      plane.axis, options.most.*plane.across + 1.3 * dx, -(options.most.*plane.across) - 1.3 * dx,
      -options.most.vx_m_s - 1.3 * dy, options.most.vx_m_s + 1.3 * dy);
  const std::string moved_name = fmt::format("{}_moved", plane.name);
  report::Data moved(moved_name.c_str());
  for (const Look& look : kLooks) {
    const std::string name = fmt::format("{}_{}", plane.name, look.name);
    report::Data block(name.c_str());
    bool any = false;
    for (const StabilityCell& cell : map.cells) {
      if (cell.asked.*plane.other != 0 || cell.end != look.end) continue;
      block.row(cell.asked.*plane.across, cell.asked.vx_m_s);
      any = true;
      if (!cell.walked) continue;
      moved.row(cell.asked.*plane.across, cell.asked.vx_m_s);
      moved.row(cell.walked.value().*plane.across, cell.walked->vx_m_s).end_row();
    }
    if (!any) continue;
    panel.data += block.text();
    panel.commands += fmt::format(
        "${0} using 1:2:($1-{1:.5g}):($1+{1:.5g}):($2-{2:.5g}):($2+{2:.5g}) with boxxyerror "
        "fillstyle transparent solid {3} noborder linetype {4} title '{5}', ",
        name, dx, dy, look.shade, look.linetype, look.name);
  }
  panel.data += moved.text();
  panel.commands += fmt::format(
      "${0} using 1:2 with lines linecolor rgb '{1}' linewidth 1 notitle, "
      "${0} using 1:2 every 2::1 with points linecolor rgb '{1}' pointtype 7 pointsize 0.45 title "
      "'really walked'\n",
      moved_name, kInk);
  return panel;
}

}  // namespace

report::Plot push_plot(const PushMap& map, const PushOptions& options) {
  std::vector<double> rows;
  for (const Side& side : sides_of(map)) rows.push_back(side.direction_rad);
  std::sort(rows.begin(), rows.end());
  std::string plot, ticks;
  const std::string data = push_cells(map, options, rows, plot);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ticks += fmt::format("{}'{}' {}", i == 0 ? "" : ", ", direction_name(rows[i]), i);
  }
  std::string script = report::preamble() + data;
  script += fmt::format(
      "unset grid\nunset border\nset xrange [-0.6:{}.6]\nset yrange [-0.6:{}.6]\n"
      "set xtics 0,1,{} scale 0\nset ytics scale 0 ({})\n"
      "set xlabel 'phase of the gait cycle'\nset ylabel 'pushed to'\nunset key\nplot {}NaN "
      "notitle\n",
      options.phases - 1, rows.empty() ? 0 : rows.size() - 1, options.phases - 1, ticks, plot);
  return {
      "push",
      "The hardest push it walks on after",
      fmt::format("Impulse in N s of a push of {:g} ms at the trunk, by where the push goes and "
                  "the gait's phase when it begins; told apart by {:g} N s, {:g} is the most "
                  "that was tried.",
                  1e3 * options.push_s, options.step_n_s, options.most_n_s()),
      920,
      110 + 34 * static_cast<int>(rows.size()),
      script};
}

report::Plot push_rose(const PushMap& map, const PushOptions& options) {
  const std::vector<Side> sides = sides_of(map);
  double most = 0.5;
  for (const Side& side : sides) most = std::max(most, side.most_n_s);
  const double end = 0.5 * std::ceil(most / 0.5);
  std::string script = report::preamble(), plot;
  for (int i = 1; 0.5 * i <= end + 1e-9; ++i) {
    const std::string name = fmt::format("circle{}", i);
    script += circle(name.c_str(), 0.5 * i);
    plot += fmt::format("${} using 1:2 with lines linecolor rgb '{}' linewidth 1 notitle, ", name,
                        kSoft);
    script += fmt::format("set label {} '{:.1f}' at {:.3f},{:.3f} textcolor rgb '{}'\n", i, 0.5 * i,
                          0.5 * i * 0.72, 0.5 * i * 0.72, kInk);
  }
  script += ring("least", sides, &Side::least_n_s) + ring("middle", sides, &Side::middle_n_s) +
            ring("most", sides, &Side::most_n_s);
  script += fmt::format(
      "unset grid\nunset border\nunset tics\nset size ratio -1\nset xrange [-{0}:{0}]\nset yrange "
      "[-{0}:{0}]\nset label 90 'ahead' at 0,{1} center textcolor rgb '{2}'\n"
      "set label 91 'left' at -{1},0 right textcolor rgb '{2}'\n"
      "set label 92 'right' at {1},0 left textcolor rgb '{2}'\n"
      "set label 93 'back' at 0,-{1} center textcolor rgb '{2}'\n"
      "set key outside right center vertical\nplot {3}"
      "$least using 1:2 with filledcurves closed linetype 1 fillstyle transparent solid 0.18 "
      "noborder notitle, "
      "$least using 1:2 with linespoints linetype 1 {4}\n",
      1.3 * end, 1.12 * end, kInk, plot,
      options.standing
          ? "notitle"
          : "title 'at the weakest phase', "
            "$middle using 1:2 with linespoints linetype 3 title 'at half of the phases', "
            "$most using 1:2 with linespoints linetype 2 title 'at the strongest phase'");
  return {"rose",
          "By direction",
          fmt::format("Seen from above: how hard a push it {} after, in N s, by where it is pushed "
                      "to.",
                      options.standing ? "stands" : "walks on"),
          720,
          480,
          script};
}

report::Plot stability_plot(const StabilityMap& map, const StabilityOptions& options) {
  const report::Panel turn = plane_panel(map, options, kPlanes[0]);
  const report::Panel side = plane_panel(map, options, kPlanes[1]);
  const std::string script = report::preamble() + turn.data + side.data +
                             "set key outside top center horizontal\nset multiplot layout 1,2\n" +
                             turn.commands + side.commands + "unset multiplot\n";
  return {"stability",
          "Velocities asked and walked",
          "Each cell is a velocity that was asked for, its colour how the walk ended; a line leads "
          "to what was really walked, which servos may have left less of.",
          920,
          480,
          script};
}

}  // namespace verp::survey
