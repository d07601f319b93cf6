#pragma once
#include <cstdint>
#include <map>
#include <string>

namespace verp::test {

/// VERP_SEED and VERP_RUNS: 0 if it is not set.
int campaign_setting(const char* name);

/// What the runs of one kind of fault came to.
struct CampaignRow {
  int runs = 0;
  std::uint64_t injected = 0, counted = 0;
  std::map<int, int> ends;  ///< mode, and how many runs ended in it
};
/// All rows that were noted are printed when the program's tests have run.
void note_campaign_row(const std::string& name, const CampaignRow& row);

}  // namespace verp::test
