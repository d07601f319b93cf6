#include "tests/hil/campaign_table.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <vector>

#include "tests/hil/promises.hpp"

namespace verp::test {
namespace {

struct Row {
  int runs = 0;
  CampaignRun sum;
  std::map<int, int> ends;  ///< mode -> runs that ended in it
};

struct Table : ::testing::Environment {
  void TearDown() override {
    if (rows.empty()) return;
    std::printf("%-28s %5s %9s %9s  %s\n", "fault", "runs", "injected", "counted", "ends");
    for (const std::string& each : rows) std::printf("%s\n", each.c_str());
  }
  std::vector<std::string> rows;
};

Table& table() {
  static auto* const kTable = new Table;  // googletest owns it
  static const auto* const kAdded = ::testing::AddGlobalTestEnvironment(kTable);
  (void)kAdded;
  return *kTable;
}

std::string to_text(const std::string& name, const Row& row) {
  std::string ends;
  for (const auto& [mode, count] : row.ends) {
    ends += (ends.empty() ? "" : ", ") + std::to_string(count) + " " + kModeNames[mode];
  }
  char line[200];
  std::snprintf(line, sizeof line, "%-28s %5d %9llu %9llu  %s", name.c_str(), row.runs,
                static_cast<unsigned long long>(row.sum.injected),
                static_cast<unsigned long long>(row.sum.counted), ends.c_str());
  return line;
}

/// 0: not set.
int setting(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr) return 0;
  const int number = std::atoi(value);
  if (number <= 0) {
    throw std::invalid_argument(std::string(name) + "=" + value + ": write a number, 1 or more");
  }
  return number;
}

}  // namespace

int wanted_runs(int runs) {
  const int most = setting("VERP_RUNS");
  return most > 0 && most < runs ? most : runs;
}

void run_seeds(const std::string& name, int runs,
               const std::function<CampaignRun(std::uint32_t seed)>& run) {
  const int only = setting("VERP_SEED");
  Row row;
  for (int seed = 1; seed <= runs; ++seed) {
    if (only != 0 && seed != only) continue;
    SCOPED_TRACE("VERP_SEED=" + std::to_string(seed) + " of " + name);
    const CampaignRun result = run(static_cast<std::uint32_t>(seed));
    ++row.runs;
    row.sum.injected += result.injected;
    row.sum.counted += result.counted;
    row.sum.walked_m += result.walked_m;
    row.sum.clean_m += result.clean_m;
    ++row.ends[result.end];
  }
  EXPECT_GT(row.runs, 0) << "no such seed";
  EXPECT_NEAR(row.sum.walked_m, row.sum.clean_m, 0.02 * row.sum.clean_m) << name;
  table().rows.push_back(to_text(name, row));
}

}  // namespace verp::test
