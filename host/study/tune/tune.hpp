#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/run/session/plan.hpp"
#include "host/study/survey/workers.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::tune {

struct Options {
  double speed_m_s = 0.2;
  int generations = 8;              ///< after the grid of cycles and hip heights
  int children = 12;                ///< tries per generation, even
  int checks = 10;                  ///< random robots as judges
  double try_s = 10, check_s = 20;  ///< of gait, in the search and in the judgement
  std::uint64_t seed = 1;           ///< of the search
};

/// Seeds of search and judgement; gates and reports use others (design: 1-10, 2001 on).
inline constexpr std::uint64_t kSearchSeed = 1001, kCheckSeed = 1501;

/// Random robots that walk within a tenth of the speed, and their means.
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
  std::vector<Number> numbers;  ///< changed; empty: nothing better
  Check before, after;
  std::string limit;  ///< why no tried Tuning walks; or empty
  int walks = 0;
  bool interrupted = false;
};

/// `plan`: with start values. Any number of threads gives the same result. Throws what
/// session::walk() throws.
Result tune(const session::WalkPlan& plan, const sim::WorldOptions& world, const Options& options,
            const survey::Watch& watch);

/// Why a robot with this Tuning cannot walk at that speed: its stance, a joint's speed, reach,
/// servo strength, or balance.
std::string limit_of(session::WalkPlan plan, const sim::WorldOptions& world, double speed_m_s);

}  // namespace verp::tune
