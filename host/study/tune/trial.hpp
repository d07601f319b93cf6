#pragma once
#include <cstdint>

#include "host/run/session/plan.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::tune {

struct Trial {
  double walk_s = 10;
  std::uint64_t seed = 1;
  bool varied = false;  ///< drawn from the seed
};

Command ahead(double speed_m_s);

session::WalkResult try_walk(session::WalkPlan plan, const sim::WorldOptions& world,
                             const Trial& trial, const std::function<bool()>& interrupted);

/// ZMP bias in mm, plus penalties for wrong speed and heading. A fall costs far more, less after a
/// longer walk.
double cost_of(const session::WalkResult& result, double walk_s, double speed_m_s);

/// A cost above any walk's: the legs cannot reach this stance.
inline constexpr double kCannotStand = 1000;

}  // namespace verp::tune
