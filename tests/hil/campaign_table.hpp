#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace verp::test {

/// What one run came to: faults that were injected, those that the operator's registers count, and
/// the mode it ended in.
struct CampaignRun {
  std::uint64_t injected = 0, counted = 0;
  int end = 0;
};

/// Of `runs` of a kind so many, if VERP_RUNS says less.
int wanted_runs(int runs);

/// Runs seeds 1 to `runs`, or VERP_SEED of them alone; a failure names its seed. What they came to
/// is printed, a row a kind, when the program's tests have run.
void run_seeds(const std::string& name, int runs,
               const std::function<CampaignRun(std::uint32_t seed)>& run);

}  // namespace verp::test
