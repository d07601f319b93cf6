#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/run/session/plan.hpp"
#include "host/study/survey/workers.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::survey {

/// Velocity of the body, in the axes of its heading.
struct Velocity {
  double vx_m_s = 0, vy_m_s = 0, wz_rad_s = 0;
};
Command command_of(const Velocity& velocity);
Velocity velocity_of(const Command& command);

struct StabilityOptions {
  int on_axis = 9;     ///< velocities on each axis; odd, so that 0 is among them
  Velocity most;       ///< ends of the grid
  double begin_s = 3;  ///< of gait, before the measurement starts
};

/// The longest steps and turns that the robot's tuning admits. Sideways is half as much, because
/// only every other step may be long.
Velocity most_of(const Params& params);

/// Gait length that covers begin_s, one measured cycle and the gait's end.
double least_walk_s(const StabilityOptions& options, double cycle_s);

struct StabilityCell {
  enum class End { kNone, kWalked, kShort, kFell, kFailed } end = End::kNone;
  Velocity asked, ordered;  ///< ordered: what the servos can follow of `asked`
  std::optional<Velocity>
      walked;       ///< mean over whole cycles; nullopt: it fell before, or did not walk
  std::string why;  ///< failure of a walk that is not good
};

/// "walked" and so on; kNone: the survey was interrupted first.
const char* name_of(StabilityCell::End end);

struct StabilityMap {
  std::vector<StabilityCell> cells;  ///< vx by wz with vy = 0; then vx by vy with wz = 0
  bool interrupted = false;
};

/// Walks the plan's robot at each velocity of two planes; ignores the plan's own velocity. Throws
/// what session::walk() throws.
StabilityMap stability_map(const session::WalkPlan& plan, const sim::WorldOptions& world,
                           const StabilityOptions& options, const Watch& watch);

}  // namespace verp::survey
