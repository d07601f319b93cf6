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

/// There is nothing to survey; what() gives the reason.
class SurveyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PushOptions {
  bool standing = false;  ///< pushes a standing robot; `phases` is then 1
  int phases = 16;        ///< in a gait cycle, evenly spaced
  int directions = 8;     ///< evenly spaced, the first one ahead
  double push_s = 0.05;
  double settle_s = 3;    ///< minimum time of gait, or of standing, before the push
  double after_s = 3;     ///< minimum time after it
  double step_n_s = 0.1;  ///< resolution of the impulse
  int steps = 31;         ///< number of impulses, each step_n_s more than the last
  double most_n_s() const { return step_n_s * steps; }
};

/// Gait length that covers settle_s, the pushed cycle and after_s.
double least_walk_s(const PushOptions& options, double cycle_s);

struct PushCell {
  int phase = 0;             ///< 0..phases-1; with 16 phases, the paper's state
  double direction_rad = 0;  ///< the push points there: 0 ahead, positive to the left
  double at_s = 0;           ///< start of the push, in time of gait
  double heading_rad = 0;    ///< of the body, at the start of the push
  /// The largest survived impulse. 0: none; PushOptions::most_n_s(): that or more; nullopt: not
  /// tried.
  std::optional<double> survives_n_s;
};

struct PushMap {
  std::string link;             ///< pushed link, at its centre of mass
  std::vector<PushCell> cells;  ///< by phase, and within a phase by direction
  std::size_t walks = 0;
  bool interrupted = false;
};

/// Options for a standing robot, with the same resolution.
PushOptions standing_pushes();

/// Bisects, in each cell, the impulse that the robot survives, to one step of step_n_s; every push
/// lasts push_s. Assumes that a robot that survives a push survives all smaller ones, which fails
/// only for a few near the limit. Every walk has the plan's seed. A robot survives if its result is
/// good (session::WalkResult); in the standing survey it must also end where it stood. Throws
/// SurveyError if the robot does not walk or stand steadily without a push, and what
/// session::walk() throws.
PushMap push_map(const session::WalkPlan& plan, const sim::WorldOptions& world,
                 const PushOptions& options, const Watch& watch);

}  // namespace verp::survey
