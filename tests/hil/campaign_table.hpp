#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace verp::test {

/// One run's result: injected faults, those counted in the operator's registers, and the final
/// mode. Both distances if the run must walk as far as without its fault.
struct CampaignRun {
  std::uint64_t injected = 0, counted = 0;
  int end = 0;
  double walked_m = 0, clean_m = 0;
};

/// The number of runs of a kind: `runs`, or fewer if VERP_RUNS says so.
int wanted_runs(int runs);

/// Runs seeds 1 to `runs`, or only VERP_SEED; a failure names its seed. Finally prints one row per
/// kind. Lost goals come a tick late and lost reports keep the last values, so no step moves. But
/// the ground's noise makes one walk of half a metre differ from another by up to 3.7 %. So all
/// seeds together must walk within 2 % of the distance without the fault.
void run_seeds(const std::string& name, int runs,
               const std::function<CampaignRun(std::uint32_t seed)>& run);

}  // namespace verp::test
