#pragma once
#include <cstdint>
#include <string>

#include "host/twin/sim/quantities.hpp"

namespace verp::session {

/// An action of the user on the twin: a push, or a new value of a quantity. It is part of the run,
/// and the trace records it with its tick.
struct Intervention {
  enum class Kind { kPush, kSet } kind = Kind::kSet;
  /// Time in the robot's run, as WalkPlan::walk_s counts: applied after the tick that reaches it.
  /// 0: after the first tick, before the robot walks.
  double at_s = 0;
  std::string name;  ///< link or object; quantity
  sim::Vec3 force_world_n = sim::Vec3::Zero();
  double for_s = 0;
  double value = 0;

  bool operator==(const Intervention&) const = default;
};

/// Read "T: LINK fx,fy,fz N for S" and "T: NAME=VALUE". Throw std::invalid_argument with the error.
Intervention read_push(const std::string& text);
Intervention read_setting(const std::string& text);

/// "push body 0,30,0 N for 0.1 s", "set body.mass_kg=2": without the time.
std::string in_words(const Intervention& intervention);

/// Throw std::invalid_argument if the name is unknown or the value is out of range.
void check(const Intervention& intervention, const sim::Quantities& quantities);
void apply(const Intervention& intervention, sim::Quantities& quantities);

struct AppliedIntervention {
  /// Tick of the robot's controller before it; 0 for a controller that reports nothing.
  std::uint32_t tick = 0;
  double time_s = 0;  ///< simulated
  std::string what;
};

}  // namespace verp::session
