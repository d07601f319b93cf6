#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/run/session/plan.hpp"
#include "host/study/survey/workers.hpp"
#include "host/twin/sim/world.hpp"

/// Tunes a robot's gait by walks in the twin.
namespace verp::tune {

struct Options {
  double speed_m_s = 0.2;
  int generations = 8;              ///< after the first grid of cycles and hip heights
  int children = 12;                ///< tries per generation, even
  int checks = 10;                  ///< random robots of this kind that judge the result
  double try_s = 10, check_s = 20;  ///< of gait, in the search and in the judgement
  std::uint64_t seed = 1;           ///< of the search
};

/// Seeds of the twins in the search and in the judgement; gates and reports use others (design:
/// 1-10, 2001 on).
inline constexpr std::uint64_t kSearchSeed = 1001, kCheckSeed = 1501;

/// How many of `of` random robots walk with a Tuning, within a tenth of the speed, and the means
/// over those.
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
  std::vector<Number> numbers;  ///< that changed; empty: nothing better was found
  Check before, after;
  std::string limit;  ///< what stops a robot that walked with no tried Tuning; empty: it walks
  int walks = 0;
  bool interrupted = false;
};

/// `plan`: the robot with its start values. The result does not depend on the number of threads.
/// Throws what session::walk() throws.
Result tune(const session::WalkPlan& plan, const sim::WorldOptions& world, const Options& options,
            const survey::Watch& watch);

/// Why a robot with this Tuning cannot walk at that speed: its stance, a joint's speed,
/// reach, servo strength, or balance.
std::string limit_of(session::WalkPlan plan, const sim::WorldOptions& world, double speed_m_s);

}  // namespace verp::tune
