#pragma once
#include <string>

#include "host/survey/page.hpp"
#include "host/survey/push_map.hpp"
#include "host/survey/stability_map.hpp"
#include "host/tool/json.hpp"
#include "host/tool/walk_options.hpp"
#include "host/tool/walk_run.hpp"

/// A map, told three ways: as a page, as text for a terminal, as JSON.
namespace verp::tool {

struct MapTold {
  survey::Page page;
  Json json;
  std::string text;
  bool interrupted = false;
};

MapTold tell(const WalkOptions& options, const WalkPlan& plan, const survey::PushMap& map,
             const survey::PushOptions& asked);
MapTold tell(const WalkOptions& options, const WalkPlan& plan, const survey::StabilityMap& map,
             const survey::StabilityOptions& asked);

}  // namespace verp::tool
