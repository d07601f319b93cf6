#pragma once
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/twin/sim/metrics.hpp"

/// Judges the distance and turn of a walk against its velocity order.
namespace verp::session {

/// The ideal path of a body at that velocity, in the frame of its start: x ahead, y left. A turning
/// walk is an arc.
struct Way {
  double length_m = 0, turn_rad = 0;
  std::vector<sim::Vec2> point_m;  ///< along the path, first and last included
};
Way asked_way(const Command& velocity, double walk_s);

/// Distance and turn that this gait can make in the time from its start to its end. Its strides
/// grow from zero to the order and shrink again, by one step change per step. Matters for short
/// walks; a long walk nearly completes the ordered way.
struct Reach {
  double length_m = 0, turn_rad = 0;
};
Reach within_reach(const Command& velocity, double walk_s, const GaitTuning& gait);

/// Why an upright walk failed: it covered less than half of the ordered way or turn in the time,
/// less the time of its first and last steps (two seconds at least). If no time remains, the limit
/// is half of what is within reach. Empty: the walk passed.
std::string shortfall(const Command& velocity, const sim::WalkMetrics& walked,
                      const GaitTuning& gait = {});
/// For a walk that passed: a remark that it was too short for the gait to reach the velocity.
/// Empty: it covered at least half the way.
std::string slow_start(const Command& velocity, const sim::WalkMetrics& walked,
                       const GaitTuning& gait = {});

}  // namespace verp::session
