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
  bool interrupted = false;            ///< somebody ended it
  std::string failure;                 ///< of the first corrected walk that failed; empty: none

  bool good() const { return failure.empty() && !interrupted; }
};

/// Walks each step length of --sweep-step with and without the multibody correction, until
/// somebody interrupts. A walk without the correction may fall: that is what it is there to show.
Sweep sweep(const WalkPlan& plan, const WalkOptions& options, cli::Progress& progress);

}  // namespace verp::tool
