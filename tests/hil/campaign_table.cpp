#include "tests/hil/campaign_table.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/hil/promises.hpp"

namespace verp::test {
namespace {

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

std::string to_text(const std::string& name, const CampaignRow& sum) {
  std::string ends;
  for (const auto& [mode, count] : sum.ends) {
    ends += (ends.empty() ? "" : ", ") + std::to_string(count) + " " + kModeNames[mode];
  }
  char line[200];
  std::snprintf(line, sizeof line, "%-28s %5d %9llu %9llu  %s", name.c_str(), sum.runs,
                static_cast<unsigned long long>(sum.injected),
                static_cast<unsigned long long>(sum.counted), ends.c_str());
  return line;
}

}  // namespace

int campaign_setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? 0 : std::atoi(value);
}

void note_campaign_row(const std::string& name, const CampaignRow& row) {
  table().rows.push_back(to_text(name, row));
}

}  // namespace verp::test
