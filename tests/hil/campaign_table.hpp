#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace verp::test {

/// What one run came to: faults that were injected, those that the operator's registers count, and
/// the mode it ended in. Of a kind that is to walk as far as without its fault, both distances too.
struct CampaignRun {
  std::uint64_t injected = 0, counted = 0;
  int end = 0;
  double walked_m = 0, clean_m = 0;
};

/// Of `runs` of a kind so many, if VERP_RUNS says less.
int wanted_runs(int runs);

/// Runs seeds 1 to `runs`, or VERP_SEED of them alone; a failure names its seed. What they came to
/// is printed, a row a kind, when the program's tests have run. Lost goals come a tick late, lost
/// reports leave the last ones standing: neither moves a step, but each step lands as the noise of
/// the ground has it, and one walk of half a metre differs from another by up to 3.7 %. So all
/// seeds together are to walk within 2 % as far as without the fault.
void run_seeds(const std::string& name, int runs,
               const std::function<CampaignRun(std::uint32_t seed)>& run);

}  // namespace verp::test
