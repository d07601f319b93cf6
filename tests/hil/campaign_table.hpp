#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace verp::test {

/// Injected faults, those in the operator's registers, the final mode; distances if the fault must
/// not shorten the walk.
struct CampaignRun {
  std::uint64_t injected = 0, counted = 0;
  int end = 0;
  double walked_m = 0, clean_m = 0;
};

/// VERP_RUNS may lower it.
int wanted_runs(int runs);

/// Runs seeds 1 to `runs`, or only VERP_SEED; prints one row per kind. The ground's noise makes a
/// walk of half a metre differ by up to 3.7 %, so all seeds together must walk within 2 % of the
/// distance without the fault.
void run_seeds(const std::string& name, int runs,
               const std::function<CampaignRun(std::uint32_t seed)>& run);

}  // namespace verp::test
