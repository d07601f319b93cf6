#pragma once
#include <string>
#include <vector>

#include "host/apps/tool/walk_options.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/study/report/run_data.hpp"

namespace verp::tool {

/// The walks of --sweep-step.
struct Sweep {
  std::vector<report::SweepRow> rows;  ///< the last may be unfinished
  bool interrupted = false;            ///< by the user
  std::string failure;  ///< of the first failed walk with the correction; empty: none

  bool good() const { return failure.empty() && !interrupted; }
};

/// Walks each step length of --sweep-step with and without the multibody correction, until the user
/// interrupts. A walk without the correction may fall, which shows the correction's effect.
Sweep sweep(const WalkPlan& plan, const WalkOptions& options, cli::Progress& progress);

}  // namespace verp::tool
