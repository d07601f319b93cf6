#pragma once
#include <cstdint>
#include <string>

#include "host/twin/sim/quantities.hpp"

namespace verp::session {

/// The user's push or new value of a quantity. It is part of the run: the trace records it.
struct Intervention {
  enum class Kind { kPush, kSet } kind = Kind::kSet;
  /// Time in the robot's run, as WalkPlan::walk_s: applied after the tick that reaches it. 0: after
  /// the first tick.
  double at_s = 0;
  std::string name;  ///< link or object; quantity
  sim::Vec3 force_world_n = sim::Vec3::Zero();
  double for_s = 0;
  double value = 0;

  bool operator==(const Intervention&) const = default;
};

/// Read "T: LINK fx,fy,fz N for S" and "T: NAME=VALUE". Throw std::invalid_argument.
Intervention read_push(const std::string& text);
Intervention read_setting(const std::string& text);

/// "push body 0,30,0 N for 0.1 s", without the time.
std::string in_words(const Intervention& intervention);

/// Throws std::invalid_argument for an unknown name or a value out of range.
void check(const Intervention& intervention, const sim::Quantities& quantities);
void apply(const Intervention& intervention, sim::Quantities& quantities);

struct AppliedIntervention {
  /// Controller's tick before it; 0 if it reports nothing.
  std::uint32_t tick = 0;
  double time_s = 0;  ///< simulated
  std::string what;
};

}  // namespace verp::session
