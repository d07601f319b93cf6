#pragma once
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/study/survey/page.hpp"
#include "host/study/survey/push_map.hpp"
#include "host/study/survey/stability_map.hpp"

namespace verp::tool {

struct MapReport {
  survey::Page page;
  cli::Json json;
  std::string text;
  bool interrupted = false;
};

MapReport tell(const WalkOptions& options, const WalkPlan& plan, const survey::PushMap& map,
               const survey::PushOptions& asked);
MapReport tell(const WalkOptions& options, const WalkPlan& plan, const survey::StabilityMap& map,
               const survey::StabilityOptions& asked);

}  // namespace verp::tool
