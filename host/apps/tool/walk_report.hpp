#pragma once
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_sweep.hpp"
#include "host/study/report/run_data.hpp"

namespace verp::tool {

report::Run to_report(const WalkPlan& plan, const WalkOptions& options,
                      const scenario::Orders& orders, const WalkResult& result, const Sweep& sweep);

std::string to_text(const WalkPlan& plan, const WalkOptions& options, const WalkResult& result,
                    const Sweep& sweep);

cli::Json fall_story_json(const WalkResult& result);

cli::Json to_json(const WalkPlan& plan, const WalkOptions& options, const WalkResult& result,
                  const Sweep& sweep);

}  // namespace verp::tool
