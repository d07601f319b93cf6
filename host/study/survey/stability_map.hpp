#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/run/session/plan.hpp"
#include "host/study/survey/workers.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::survey {

/// Velocity in the axes of the body's heading.
struct Velocity {
  double vx_m_s = 0, vy_m_s = 0, wz_rad_s = 0;
};
Command command_of(const Velocity& velocity);
Velocity velocity_of(const Command& command);

struct StabilityOptions {
  int on_axis = 9;     ///< odd, with 0 among them
  Velocity most;       ///< ends of the grid
  double begin_s = 3;  ///< gait before measuring
};

/// Longest steps and turns of the tuning. Sideways is half: only every other step may be long.
Velocity most_of(const Params& params);

/// Gait length that covers begin_s, one cycle and the gait's end.
double least_walk_s(const StabilityOptions& options, double cycle_s);

struct StabilityCell {
  enum class End { kNone, kWalked, kShort, kFell, kFailed } end = End::kNone;
  Velocity asked, ordered;         ///< ordered: what the servos can follow of `asked`
  std::optional<Velocity> walked;  ///< over whole cycles; nullopt: it fell before, or did not walk
  std::string why;                 ///< of a failed walk
};

/// "walked" and so on; kNone: the survey was interrupted first.
const char* name_of(StabilityCell::End end);

struct StabilityMap {
  std::vector<StabilityCell> cells;  ///< vx by wz with vy = 0; then vx by vy with wz = 0
  bool interrupted = false;
};

/// Walks at each velocity of two planes, not the plan's. Throws what session::walk() throws.
StabilityMap stability_map(const session::WalkPlan& plan, const sim::WorldOptions& world,
                           const StabilityOptions& options, const Watch& watch);

}  // namespace verp::survey
