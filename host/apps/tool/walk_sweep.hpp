#pragma once
#include <string>
#include <vector>

#include "host/apps/tool/walk_options.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/study/report/run_data.hpp"

namespace verp::tool {

struct Sweep {
  std::vector<report::SweepRow> rows;  ///< last may be unfinished
  bool interrupted = false;            ///< by the user
  std::string failure;                 ///< first failed walk with the correction

  bool good() const { return failure.empty() && !interrupted; }
};

/// Walks each step length with and without the multibody correction. Without it a walk may fall.
Sweep sweep(const WalkPlan& plan, const WalkOptions& options, cli::Progress& progress);

}  // namespace verp::tool
