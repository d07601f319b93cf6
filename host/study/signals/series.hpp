#pragma once
#include <cstddef>
#include <vector>

#include "host/study/signals/table.hpp"
#include "host/trace/record/tick_range.hpp"

namespace verp::signals {

/// Some columns of a trace over a time, to be drawn.
struct Series {
  std::vector<Column> columns;
  std::vector<double> time_s;
  std::vector<std::vector<double>> numbers;  ///< of each column at each time; not a number: unknown
};

/// Columns `chosen` of a table whose first row is not read yet, at those ticks.
Series series_of(Table& table, const std::vector<std::size_t>& chosen, record::TickRange ticks);

/// Points of a line, fewer than there were: the least and the most of each few in a row, so that a
/// picture of it is the same.
struct Line {
  std::vector<double> time_s, numbers;
};
Line thinned(const std::vector<double>& time_s, const std::vector<double>& numbers,
             std::size_t most_points);

/// Columns, by their place, that share one axis: of one unit, measured and goal of a joint never
/// apart, and no more lines than eyes can tell from each other. A number without unit has an axis
/// of its own.
std::vector<std::vector<std::size_t>> panels_of(const std::vector<Column>& columns);

}  // namespace verp::signals
