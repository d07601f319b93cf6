#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "host/study/report/plots.hpp"
#include "host/study/signals/table.hpp"
#include "host/trace/record/tick_range.hpp"

namespace verp::signals {

struct Series {
  std::vector<Column> columns;
  std::vector<double> time_s;
  std::vector<std::vector<double>> numbers;  ///< by column, then time; NaN: unknown
};

/// The table must not have read a row yet.
Series series_of(Table& table, const std::vector<std::size_t>& chosen, record::TickRange ticks);

/// Minimum and maximum of each group: the drawn line looks the same.
struct Line {
  std::vector<double> time_s, numbers;
};
Line thinned(const std::vector<double>& time_s, const std::vector<double>& numbers,
             std::size_t most_points);

/// Columns per axis: one unit, few lines; measured and goal of a joint share one. A number without
/// a unit has its own axis.
std::vector<std::vector<std::size_t>> panels_of(const std::vector<Column>& columns);

/// Panels (panels_of()) on one time axis; joint goals are dashed.
report::Plot plot_of(const Series& series, const std::string& title);

}  // namespace verp::signals
