#pragma once
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/sim/metrics.hpp"

/// What a velocity asks of a walk, and what a walk made of it.
namespace verp::session {

/// Where a body that keeps the velocity is from tick to tick, seen from where it starts: x ahead, y
/// to its left. A turning walk is an arc.
struct Way {
  double length_m = 0, turn_rad = 0;
  std::vector<sim::Vec2> point_m;  ///< along it, first and last included
};
Way asked_way(const Command& velocity, double walk_s);

/// Why a walk that ended on its feet is none: it covered less than half of the way or the turn that
/// the velocity makes in the time, less what the gait takes for its first and last steps (two
/// seconds at least). Empty: it is one.
std::string shortfall(const Command& velocity, const sim::WalkMetrics& walked,
                      const GaitTuning& gait = {});

}  // namespace verp::session
