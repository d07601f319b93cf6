#include "host/study/signals/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/study/report/script.hpp"

namespace verp::signals {
namespace {

constexpr std::size_t kMostLines = 6;  // colours of the palette

using Places = std::vector<std::size_t>;

/// Groups in order of first appearance.
template <class Key>
std::vector<Places> grouped(const std::vector<Column>& columns, const Places& places, Key key) {
  std::vector<Places> groups;
  for (const std::size_t i : places) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Places& group) {
      return key(columns[group.front()]) == key(columns[i]);
    });
    if (same == groups.end()) {
      groups.push_back({i});
    } else {
      same->push_back(i);
    }
  }
  return groups;
}

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

Series series_of(Table& table, const std::vector<std::size_t>& chosen, record::TickRange ticks) {
  Series series;
  for (const std::size_t i : chosen) series.columns.push_back(table.columns()[i]);
  series.numbers.resize(chosen.size());
  while (table.next() && table.index() <= ticks.last) {
    if (table.index() < ticks.first) continue;
    series.time_s.push_back(table.time_s());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      series.numbers[k].push_back(table.number(chosen[k]));
    }
  }
  return series;
}

Line thinned(const std::vector<double>& time_s, const std::vector<double>& numbers,
             std::size_t most_points) {
  const std::size_t all = numbers.size();
  if (all <= most_points) return {time_s, numbers};
  Line line;
  const std::size_t few = (2 * all + most_points - 1) / most_points;
  for (std::size_t from = 0; from < all; from += few) {
    const std::size_t to = std::min(from + few, all);
    std::size_t low = from, high = from;  // unknown numbers are kept
    for (std::size_t i = from; i < to; ++i) {
      if (std::isnan(numbers[low]) || numbers[i] < numbers[low]) low = i;
      if (std::isnan(numbers[high]) || numbers[i] > numbers[high]) high = i;
    }
    for (const std::size_t i : {std::min(low, high), std::max(low, high)}) {
      if (!line.time_s.empty() && line.time_s.back() == time_s[i]) continue;
      line.time_s.push_back(time_s[i]);
      line.numbers.push_back(numbers[i]);
    }
  }
  return line;
}

std::vector<std::vector<std::size_t>> panels_of(const std::vector<Column>& columns) {
  Places all(columns.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<Places> panels;
  for (const Places& unit :
       grouped(columns, all, [](const Column& c) { return c.unit.empty() ? c.name : c.unit; })) {
    panels.emplace_back();
    for (const Places& subject :
         grouped(columns, unit, [](const Column& c) { return c.subject; })) {
      const bool room = panels.back().size() + subject.size() <= kMostLines;
      if (!room && !panels.back().empty()) panels.emplace_back();
      panels.back().insert(panels.back().end(), subject.begin(), subject.end());
    }
  }
  return panels;
}

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
