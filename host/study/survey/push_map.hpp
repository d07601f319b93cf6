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

/// There is nothing to survey; what() says why.
class SurveyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How hard a robot may be pushed, at each phase of its gait and from each side.
struct PushOptions {
  bool standing = false;  ///< it is pushed where it stands, and `phases` is 1
  int phases = 16;        ///< of the gait cycle, evenly apart
  int directions = 8;     ///< evenly apart, the first one ahead
  double push_s = 0.05;
  double settle_s = 3;    ///< of gait, or on its feet, at least, before it is pushed
  double after_s = 3;     ///< and at least so much of it afterwards
  double step_n_s = 0.1;  ///< impulses are told apart by so much,
  int steps = 31;         ///< and are at most so many of them
  double most_n_s() const { return step_n_s * steps; }
};

/// The gait's length that leaves room for settle_s, the cycle that is pushed, and after_s.
double least_walk_s(const PushOptions& options, double cycle_s);

struct PushCell {
  int phase = 0;             ///< 0..phases-1; of 16, the paper's state
  double direction_rad = 0;  ///< where it is pushed to: 0 ahead, to the left is positive
  double at_s = 0;           ///< of gait, when the push begins
  double heading_rad = 0;    ///< of the body then
  /// The largest impulse that it walked on after; 0: none of them. PushOptions::most_n_s(): that,
  /// or more. None: it was not tried.
  std::optional<double> survives_n_s;
};

struct PushMap {
  std::string link;             ///< that is pushed, at its centre of mass
  std::vector<PushCell> cells;  ///< phase by phase, each with all directions
  std::size_t walks = 0;
  bool interrupted = false;
};

/// Those of a robot that stands, to the same precision.
PushOptions standing_pushes();

/// Walks the plan, or stands, with a push of push_s in each cell, and halves the range of impulses
/// until the largest that the robot survives is known to one step. It takes for granted that
/// whoever survives a push survives smaller ones, which is so but for a few near the limit. Each
/// walk has the plan's seed, and to survive is to be good (session::WalkResult), and to stand in
/// the end where it stood. Throws SurveyError where the robot does not walk, or stand, without a
/// push, or not steadily, and what session::walk() throws.
PushMap push_map(const session::WalkPlan& plan, const sim::WorldOptions& world,
                 const PushOptions& options, const Watch& watch);

}  // namespace verp::survey
