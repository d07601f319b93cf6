#include "host/study/signals/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace verp::signals
