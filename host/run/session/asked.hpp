#pragma once
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/twin/sim/metrics.hpp"

namespace verp::session {

/// Ideal path of a body in the frame of its start: x ahead, y left. A turn makes it an arc.
struct Way {
  double length_m = 0, turn_rad = 0;
  std::vector<sim::Vec2> point_m;  ///< along the path, both ends included
};
Way asked_way(const Command& velocity, double walk_s);

/// Distance and turn that this gait can make in the time. Strides grow and shrink by one step
/// change per step, which matters for short walks.
struct Reach {
  double length_m = 0, turn_rad = 0;
};
Reach within_reach(const Command& velocity, double walk_s, const GaitTuning& gait);

/// Why an upright walk failed: it made less than half of the ordered way or turn in the time, less
/// its first and last steps (two seconds at least); without time left, of what is within reach.
/// Empty: it passed.
std::string shortfall(const Command& velocity, const sim::WalkMetrics& walked,
                      const GaitTuning& gait = {});
/// A remark on a passed walk that was too short for the gait to reach the velocity. Empty: at least
/// half the way.
std::string slow_start(const Command& velocity, const sim::WalkMetrics& walked,
                       const GaitTuning& gait = {});

}  // namespace verp::session
