#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace verp::test {

/// One run's result: injected faults, faults counted in the operator's registers, and the final
/// mode. If the run must walk as far as without its fault, also both distances.
struct CampaignRun {
  std::uint64_t injected = 0, counted = 0;
  int end = 0;
  double walked_m = 0, clean_m = 0;
};

/// The number of runs of a kind: `runs`, or fewer if VERP_RUNS says so.
int wanted_runs(int runs);

/// Runs seeds 1 to `runs`, or only VERP_SEED; a failure names its seed. After the program's tests,
/// prints one row per kind. Lost goals come a tick late, and lost reports keep the last values, so
/// no step moves. But each landing depends on the ground's noise: one walk of half a metre differs
/// from another by up to 3.7 %. So all seeds together must walk within 2 % of the distance without
/// the fault.
void run_seeds(const std::string& name, int runs,
               const std::function<CampaignRun(std::uint32_t seed)>& run);

}  // namespace verp::test
