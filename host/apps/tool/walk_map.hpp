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

/// Options for many walks that make one map (host/study/survey): --map, --map-grid.
struct MapOptions {
  std::string kind;           ///< push or stability; empty: one walk as ever
  int grid = 0;               ///< 0: as each map has it by itself
  bool length_given = false;  ///< --for
};

constexpr int kMostOnMapAxis = 41;

/// After all options that it excludes.
void declare(CLI::App& app, MapOptions& options);

/// Surveys, answers in text or JSON, writes the page. What is done when somebody interrupts is told
/// all the same, with exit status 1. Throws ToolError.
int walk_map(const WalkOptions& options, const Walk& walk);

}  // namespace verp::tool
