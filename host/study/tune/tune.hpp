#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/run/session/plan.hpp"
#include "host/study/survey/workers.hpp"
#include "host/twin/sim/world.hpp"

/// A gait for a robot that nobody has tuned: numbers of its Tuning, by walks in the twin.
namespace verp::tune {

struct Options {
  double speed_m_s = 0.2;  ///< ahead
  int generations = 8;     ///< after a first look at cycles and hip heights
  int children = 12;       ///< tries of a generation, even
  int checks = 10;         ///< random robots of this kind, by which what was found is judged
  double try_s = 10, check_s = 20;  ///< of gait, in the search and when it is judged
  std::uint64_t seed = 1;           ///< of the search
};

/// Seeds of the twins: those of the search, and of the judgement. Of neither gates nor reports
/// (design: 1-10, 2001 on).
inline constexpr std::uint64_t kSearchSeed = 1001, kCheckSeed = 1501;

/// How many random robots walk with a Tuning, within a tenth of the speed, of those that were
/// asked; of those that do, means.
struct Check {
  int walked = 0, of = 0;
  std::optional<double> bias_mm, speed_m_s;
};

Check sum_up(const std::vector<session::WalkResult>& results, double asked_m_s);

struct Number {
  int id = 0;  ///< of the Tuning
  std::string name;
  float was = 0, now = 0;
};

struct Result {
  std::vector<Number> numbers;  ///< that changed; empty: what there was is better than all found
  Check before, after;
  std::string limit;  ///< it walks with nothing that was tried: what stops it; empty: it walks
  int walks = 0;      ///< that were simulated
  bool interrupted = false;
};

/// `plan`: the robot with the numbers from which to begin. Does the same on any number of threads.
/// Throws what session::walk() throws.
Result tune(const session::WalkPlan& plan, const sim::WorldOptions& world, const Options& options,
            const survey::Watch& watch);

/// What stops a robot with this Tuning from walking so fast: legs that cannot stand so, a joint's
/// speed, reach, a servo's strength, or balance.
std::string limit_of(session::WalkPlan plan, const sim::WorldOptions& world, double speed_m_s);

}  // namespace verp::tune
