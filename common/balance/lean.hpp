#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/gait.hpp"

/// Upright on ground that slopes to a side. Legs of equal length hold the body at a right angle to
/// the ground: across 5 degrees its CoM is then 2 cm downhill of where the plan has it. Where the
/// body goes on being tilted, the plan is turned over the ground by what is too much, and the CoM
/// is where it belongs. Ahead and backward soles are long enough to do without.
namespace verp::balance {

struct LeanState {
  float tilt_rad = 0;  ///< roll, without what a step sways
  float lean_rad = 0;  ///< about x, on top of the plan: against the tilt
  VERP_FIELDS(tilt_rad, lean_rad)
};
VERP_PACKED(LeanState);

/// So much tilt is left: an accelerometer's offset (25 mg), and floors that pass for level.
inline constexpr float kLeftTilted_rad = 0.026F;

/// Once a tick, of a robot that walks.
void learn_lean(const AttitudeOut& attitude, float period_s, LeanState& state);

/// Turns the plan's body about the ground under it.
void lean(const LeanState& state, gait::Posture& posture);

}  // namespace verp::balance
