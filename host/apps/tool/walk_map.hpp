#pragma once
#include <string>

#include "host/apps/tool/walk_run.hpp"
#include "host/twin/sim/world.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

struct WalkOptions;
struct Walk;

/// --map and --map-grid (host/study/survey).
struct MapOptions {
  std::string kind;           ///< push or stability; empty: one walk
  int grid = 0;               ///< 0: each map's default
  bool length_given = false;  ///< --for
};

constexpr int kMostOnMapAxis = 41;

/// Call it after all options that it excludes.
void declare(CLI::App& app, MapOptions& options);

/// Runs the survey, answers and writes the page. An interrupted one reports its finished part,
/// status 1. Throws ToolError.
int walk_map(const WalkOptions& options, const Walk& walk);

}  // namespace verp::tool
