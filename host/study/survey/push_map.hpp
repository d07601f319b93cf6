#pragma once
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/run/session/plan.hpp"
#include "host/study/survey/workers.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::survey {

/// Nothing to survey; what() has the reason.
class SurveyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PushOptions {
  bool standing = false;  ///< pushes a standing robot; `phases` is then 1
  int phases = 16;        ///< of a gait cycle
  int directions = 8;     ///< the first one ahead
  double push_s = 0.05;
  double settle_s = 3;    ///< before the push, at least
  double after_s = 3;     ///< minimum time after it
  double step_n_s = 0.1;  ///< resolution of the impulse
  int steps = 31;         ///< number of impulses, each step_n_s more
  double most_n_s() const { return step_n_s * steps; }
};

/// Gait length that covers settle_s, the pushed cycle and after_s.
double least_walk_s(const PushOptions& options, double cycle_s);

struct PushCell {
  int phase = 0;             ///< 0..phases-1; with 16 phases, the paper's state
  double direction_rad = 0;  ///< of the push: 0 ahead, positive left
  double at_s = 0;           ///< start of the push, in time of gait
  double heading_rad = 0;    ///< at the push
  /// Largest survived impulse. 0: none; PushOptions::most_n_s(): that or more; nullopt: not tried.
  std::optional<double> survives_n_s;
};

struct PushMap {
  std::string link;             ///< at its centre of mass
  std::vector<PushCell> cells;  ///< by phase, then direction
  std::size_t walks = 0;
  bool interrupted = false;
};

/// For a standing robot, with the same resolution.
PushOptions standing_pushes();

/// Bisects the survived impulse of each cell to one step_n_s; pushes last push_s. Assumes that a
/// survivor survives smaller pushes, too, which fails only for a few near the limit. Every walk has
/// the plan's seed. Survival is a good result (session::WalkResult); a standing robot must also end
/// where it stood. Throws SurveyError if the robot is not steady without a push, and what
/// session::walk() throws.
PushMap push_map(const session::WalkPlan& plan, const sim::WorldOptions& world,
                 const PushOptions& options, const Watch& watch);

}  // namespace verp::survey
