#pragma once
#include <cstdint>
#include <string>

#include "host/twin/sim/quantities.hpp"

namespace verp::session {

/// Something that a person does to the twin, besides what a robot's controller does: a push, or a
/// quantity set to a value. It is a part of the run, and recorded with its tick.
struct Intervention {
  enum class Kind { kPush, kSet } kind = Kind::kSet;
  double at_s = 0;   ///< of the robot's run, as WalkPlan::walk_s counts: after the tick in which it
                     ///< has gone by. 0: the first one, before the robot walks
  std::string name;  ///< link or object; quantity
  sim::Vec3 force_world_n = sim::Vec3::Zero();
  double for_s = 0;
  double value = 0;

  bool operator==(const Intervention&) const = default;
};

/// Read "T: LINK fx,fy,fz N for S" and "T: NAME=VALUE". Throw std::invalid_argument that says what
/// is wrong in them.
Intervention read_push(const std::string& text);
Intervention read_setting(const std::string& text);

/// "push body 0,30,0 N for 0.1 s", "set body.mass_kg=2": without the time.
std::string in_words(const Intervention& intervention);

/// Throw std::invalid_argument where there is nothing of the name, or the value is out of range.
void check(const Intervention& intervention, const sim::Quantities& quantities);
void apply(const Intervention& intervention, sim::Quantities& quantities);

/// One that was done.
struct AppliedIntervention {
  std::uint32_t tick =
      0;              ///< of the robot's controller, after which it was; 0 of one that is silent
  double time_s = 0;  ///< simulated
  std::string what;
};

}  // namespace verp::session
