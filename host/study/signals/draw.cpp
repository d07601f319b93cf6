#include "host/study/signals/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/study/report/script.hpp"

namespace verp::signals {
namespace {

constexpr int kWidth_px = 1100, kHead_px = 36, kFoot_px = 52, kGap_px = 16;
constexpr int kPanel_px = 190, kLowPanel_px = 110;  // low: few values
constexpr int kLeft_px = 82, kLetter_px = 8;        // names are on the right
constexpr std::size_t kMostPoints = 4000;

using Places = std::vector<std::size_t>;

/// Quotes text in single quotes; names come from files.
std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ') continue;
    out += c;
    if (c == '\'') out += c;
  }
  return "'" + out + "'";
}

bool is_goal(const Column& column) {
  return column.name.starts_with("goal_");
}

bool steps(const Column& column) {
  return column.format == Format::kWhole;
}

std::string data_of(const Series& series, std::size_t column) {
  report::Data data(fmt::format("s{}", column).c_str());
  const Line line = thinned(series.time_s, series.numbers[column], kMostPoints);
  for (std::size_t i = 0; i < line.time_s.size(); ++i) {
    data.cell(line.time_s[i], 9).cell(line.numbers[i]).end_row();
  }
  return data.text();
}

std::string lines_of(const Series& series, const Places& panel) {
  std::string out;
  for (std::size_t k = 0; k < panel.size(); ++k) {
    const Column& column = series.columns[panel[k]];
    out += fmt::format("{} $s{} using 1:2 with {} linetype {}{} title {}", k == 0 ? "" : ",",
                       panel[k], steps(column) ? "steps" : "lines", k + 1,
                       is_goal(column) ? " dashtype (9,5) linewidth 1.5" : "", quoted(column.name));
  }
  return "plot" + out + "\n";
}

/// Phases get whole tics; without known values 0 to 1.
std::string range_of(const Series& series, const Places& panel) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t i : panel) {
    for (const double number : series.numbers[i]) {
      if (std::isfinite(number)) low = std::min(low, number), high = std::max(high, number);
    }
  }
  if (low > high) return "set yrange [0:1]\nset ytics autofreq\n";
  if (!steps(series.columns[panel.front()])) return "set yrange [*:*]\nset ytics autofreq\n";
  const double margin = std::max(0.15 * (high - low), 0.3);
  return fmt::format("set yrange [{:.9g}:{:.9g}]\nset ytics {}\n", low - margin, high + margin,
                     high - low <= 6 ? "1" : "autofreq");
}

int height_of(const Series& series, const Places& panel) {
  return steps(series.columns[panel.front()]) ? kLowPanel_px : kPanel_px;
}

}  // namespace

report::Plot plot_of(const Series& series, const std::string& title) {
  const std::vector<Places> panels = panels_of(series.columns);
  int height_px = kHead_px + kFoot_px - kGap_px;
  for (const Places& panel : panels) height_px += height_of(series, panel) + kGap_px;
  const auto up = [&](int down_px) { return 1 - static_cast<double>(down_px) / height_px; };

  std::string script = report::preamble();
  for (std::size_t i = 0; i < series.columns.size(); ++i) script += data_of(series, i);
  std::size_t letters = 0;
  for (const Column& column : series.columns) letters = std::max(letters, column.name.size());
  const int right_px = std::min(kWidth_px / 2, 60 + kLetter_px * static_cast<int>(letters));
  // A single tick needs a range, too.
  const double from_s = series.time_s.front(), to_s = std::max(series.time_s.back(), from_s + 1e-3);
  script += fmt::format(
      "set encoding utf8\nset multiplot\nset xrange [{:.9g}:{:.9g}]\nset lmargin at screen {:.5f}\n"
      "set rmargin at screen {:.5f}\nset format x ''\n"
      "set label 1 {} at screen {:.5f},{:.5f} noenhanced font ',14'\n",
      from_s, to_s, static_cast<double>(kLeft_px) / kWidth_px,
      1 - static_cast<double>(right_px) / kWidth_px, quoted(title),
      static_cast<double>(kLeft_px) / kWidth_px, up(kHead_px / 2));
  int down_px = kHead_px;
  for (const Places& panel : panels) {
    const int panel_px = height_of(series, panel);
    script += fmt::format(
        "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\nset ylabel {} noenhanced\n"
        "{}set key at graph 1.02,1 left top vertical\n",
        up(down_px), up(down_px + panel_px), quoted(series.columns[panel.front()].unit),
        range_of(series, panel));
    if (&panel == &panels.back()) script += "set format x\nset xlabel 'time, s'\n";
    script += lines_of(series, panel) + "unset label 1\n";
    down_px += panel_px + kGap_px;
  }
  return {"signals", title, "", kWidth_px, height_px, script + "unset multiplot\n"};
}

}  // namespace verp::signals
