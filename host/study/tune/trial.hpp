#pragma once
#include <cstdint>

#include "host/run/session/plan.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::tune {

/// One walk with a Tuning, on one seed.
struct Trial {
  double walk_s = 10;
  std::uint64_t seed = 1;
  bool varied = false;  ///< another robot of this kind, drawn from the seed
};

/// Straight ahead.
Command ahead(double speed_m_s);

session::WalkResult try_walk(session::WalkPlan plan, const sim::WorldOptions& world,
                             const Trial& trial, const std::function<bool()>& interrupted);

/// What a walk costs: its ZMP bias, mm, and more for other speeds and headings than were asked; one
/// that fell, far more, and less the longer it walked.
double cost_of(const session::WalkResult& result, double walk_s, double speed_m_s);

/// Beyond any walk's: the legs cannot stand so.
inline constexpr double kCannotStand = 1000;

}  // namespace verp::tune
