#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "host/study/signals/csv.hpp"
#include "host/study/signals/draw.hpp"
#include "tests/host/record/sample.hpp"

namespace verp::signals {
namespace {

using record::test::sample_params;
using record::test::sample_run;

std::vector<std::string> names_of(const std::vector<Column>& columns,
                                  const std::vector<std::size_t>& places) {
  std::vector<std::string> names;
  for (const std::size_t i : places) names.push_back(columns[i].name);
  return names;
}

using Names = std::vector<std::string>;

TEST(Columns, AreFoundByNameOrByPattern) {
  const std::vector<Column> all = columns_of(sample_params(), true);
  const auto found = [&](const char* pattern) { return names_of(all, matching(all, pattern)); };
  EXPECT_EQ(found("rad.l_knee"), Names{"rad.l_knee"});
  EXPECT_EQ(found("*rad*knee"), (Names{"rad.l_knee", "rad_s.l_knee", "goal_rad.l_knee"}));
  EXPECT_EQ(found("gyro_imu_rad_s.?").size(), 3u);
  EXPECT_EQ(found("state.digest.stage[3]"), Names{"state.digest.stage[3]"});
  EXPECT_EQ(found("state.digest.stage[*").size(), static_cast<std::size_t>(kStages));
  EXPECT_EQ(found("*").size(), all.size());
  EXPECT_EQ(found("rad.r_knee"), Names{});
  EXPECT_EQ(found(""), Names{});
}

TEST(Table, HasTheSameNumbersAsItsCsv) {
  const record::Trace trace = sample_run(130);
  Table table(trace, true), again(trace, true);
  std::ostringstream csv;
  write_csv(again, csv);
  std::istringstream lines(csv.str());
  std::string line, cell;
  std::getline(lines, line);
  EXPECT_EQ(std::count(line.begin(), line.end(), ',') + 1,
            static_cast<std::ptrdiff_t>(table.columns().size()));
  for (int ticks = 0; std::getline(lines, line); ++ticks) {
    ASSERT_TRUE(table.next());
    std::istringstream cells(line);
    for (std::size_t i = 0; i < table.columns().size(); ++i) {
      std::getline(cells, cell, ',');
      ASSERT_NEAR(table.number(i), std::stod(cell), 1e-4 * (1 + std::abs(table.number(i))))
          << table.columns()[i].name << " at tick " << ticks;
    }
  }
  EXPECT_FALSE(table.next());
  EXPECT_FALSE(table.other_from());
}

// Measured columns of another revision remain; others are NaN.
TEST(Table, LeavesOutWhatThisProgramDecidesOtherwise) {
  record::Trace trace = sample_run(20);
  trace.ticks[7].digest.chain ^= 1;
  Table table(trace, true);
  const auto column = [&](const char* name) { return matching(table.columns(), name).at(0); };
  while (table.next()) {
    const bool known = table.index() < 7;
    EXPECT_EQ(std::isnan(table.number(column("goal_rad.l_hip"))), !known);
    EXPECT_EQ(std::isnan(table.number(column("mode"))), !known);
    EXPECT_EQ(std::isnan(table.number(column("state.steer.heading_rad"))), !known);
    EXPECT_NEAR(table.number(column("rad.l_hip")), static_cast<double>(table.index()) / 651.9,
                1e-6);
  }
  EXPECT_EQ(table.other_from(), 7u);
}

TEST(Panels, KeepMeasuredAndGoalTogetherAndUnitsApart) {
  std::vector<Column> columns = {{"rad.a", "rad", "a"},      {"goal_rad.b", "rad", "b"},
                                 {"rad_s.a", "rad/s", "a"},  {"mode", "", "mode"},
                                 {"goal_rad.a", "rad", "a"}, {"stance", "", "stance"},
                                 {"rad.b", "rad", "b"}};
  using Panels = std::vector<std::vector<std::size_t>>;
  EXPECT_EQ(panels_of(columns), (Panels{{0, 4, 1, 6}, {2}, {3}, {5}}));
  for (const char* joint : {"c", "d", "e"}) {
    columns.push_back({std::string("rad.") + joint, "rad", joint});
    columns.push_back({std::string("goal_rad.") + joint, "rad", joint});
  }
  EXPECT_EQ(panels_of(columns), (Panels{{0, 4, 1, 6, 7, 8}, {9, 10, 11, 12}, {2}, {3}, {5}}));
}

// One tick's fault shows in an hour's picture.
TEST(Thinned, KeepsWhatStandsOut) {
  std::vector<double> time_s, numbers;
  for (int i = 0; i < 360000; ++i) {
    time_s.push_back(0.01 * i);
    numbers.push_back(i == 123456 ? -5 : std::sin(0.01 * i));
  }
  numbers[300000] = std::numeric_limits<double>::quiet_NaN();
  const Line line = thinned(time_s, numbers, 4000);
  EXPECT_LE(line.numbers.size(), 4000u);
  EXPECT_GT(line.numbers.size(), 3000u);
  EXPECT_EQ(std::count(line.numbers.begin(), line.numbers.end(), -5), 1);
  EXPECT_TRUE(std::is_sorted(line.time_s.begin(), line.time_s.end()));
  EXPECT_EQ(thinned(time_s, numbers, 400000).numbers.size(), 360000u);
}

// Names come from files, and gnuplot has commands.
TEST(Draw, TakesNoCommandFromAName) {
  Series series{{{"rad.x' ; system 'touch pwned", "rad", "x"}}, {0, 1}, {{0, 1}}};
  const std::string script = plot_of(series, "it's a\nrun").script;
  EXPECT_NE(script.find("title 'rad.x'' ; system ''touch pwned'"), std::string::npos) << script;
  EXPECT_NE(script.find("'it''s arun'"), std::string::npos) << script;
}

}  // namespace
}  // namespace verp::signals
