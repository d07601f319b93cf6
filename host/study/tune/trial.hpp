#pragma once
#include <cstdint>

#include "host/run/session/plan.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::tune {

struct Trial {
  double walk_s = 10;
  std::uint64_t seed = 1;
  bool varied = false;  ///< a random robot of this kind, drawn from the seed
};

Command ahead(double speed_m_s);

session::WalkResult try_walk(session::WalkPlan plan, const sim::WorldOptions& world,
                             const Trial& trial, const std::function<bool()>& interrupted);

/// Cost of a walk: its ZMP bias in mm, plus penalties for deviations from the requested speed and
/// heading. A fall costs far more, the less the longer the robot walked.
double cost_of(const session::WalkResult& result, double walk_s, double speed_m_s);

/// Above the cost of any walk: the legs cannot reach this stance.
inline constexpr double kCannotStand = 1000;

}  // namespace verp::tune
