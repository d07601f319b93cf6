#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/run/session/plan.hpp"
#include "host/study/survey/workers.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::survey {

/// Of the body, in its own heading's axes.
struct Velocity {
  double vx_m_s = 0, vy_m_s = 0, wz_rad_s = 0;
};
Command command_of(const Velocity& velocity);
Velocity velocity_of(const Command& command);

struct StabilityOptions {
  int on_axis = 9;     ///< velocities on each axis, odd: zero is among them
  Velocity most;       ///< the grid's ends
  double begin_s = 3;  ///< of gait, after which what was really walked is measured
};

/// The longest steps and turns that the robot's tuning admits, and half as much sideways, where
/// only every other step may be long.
Velocity most_of(const Params& params);

/// The gait's length that leaves room for begin_s, a cycle that is measured, and the gait's end.
double least_walk_s(const StabilityOptions& options, double cycle_s);

struct StabilityCell {
  enum class End { kNone, kWalked, kShort, kFell, kFailed } end = End::kNone;
  Velocity asked, ordered;  ///< the order: what the servos can follow of what was asked
  std::optional<Velocity>
      walked;       ///< mean over whole cycles; none: it fell before, or did not walk
  std::string why;  ///< of a walk that is not good
};

/// "walked" and so on; kNone: the survey was interrupted before.
const char* name_of(StabilityCell::End end);

struct StabilityMap {
  std::vector<StabilityCell> cells;  ///< vx with wz where vy is 0; then vx with vy where wz is 0
  bool interrupted = false;
};

/// Has the plan's robot walk at each velocity of two planes, the plan's own velocity aside. Throws
/// what session::walk() throws.
StabilityMap stability_map(const session::WalkPlan& plan, const sim::WorldOptions& world,
                           const StabilityOptions& options, const Watch& watch);

}  // namespace verp::survey
