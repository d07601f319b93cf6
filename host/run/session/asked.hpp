#pragma once
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/twin/sim/metrics.hpp"

/// What a velocity asks of a walk, and what a walk made of it.
namespace verp::session {

/// Where a body that keeps the velocity is from tick to tick, seen from where it starts: x ahead, y
/// to its left. A turning walk is an arc.
struct Way {
  double length_m = 0, turn_rad = 0;
  std::vector<sim::Vec2> point_m;  ///< along it, first and last included
};
Way asked_way(const Command& velocity, double walk_s);

/// How far a gait gets that starts and stops as this one does, in so long from its start to its
/// end: its strides grow from nothing to what is asked and shrink again, by a step's change a step,
/// and nothing else holds it up. What a short walk comes to; a long one is little short of its way.
struct Reach {
  double length_m = 0, turn_rad = 0;
};
Reach within_reach(const Command& velocity, double walk_s, const GaitTuning& gait);

/// Why a walk that ended on its feet is none: it covered less than half of the way or the turn that
/// the velocity makes in the time, less what the gait takes for its first and last steps (two
/// seconds at least); or, where that leaves nothing, less than half of what is within reach. Empty:
/// it is one.
std::string shortfall(const Command& velocity, const sim::WalkMetrics& walked,
                      const GaitTuning& gait = {});
/// Of a walk that is one: that it was too short for its gait to come near the velocity. Empty: it
/// was not, it went at least half the way.
std::string slow_start(const Command& velocity, const sim::WalkMetrics& walked,
                       const GaitTuning& gait = {});

}  // namespace verp::session
