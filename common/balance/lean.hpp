#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/gait.hpp"

/// Upright on ground that slopes. Legs of equal length hold the body at a right angle to the
/// ground: across 5 degrees its CoM is then 2 cm downhill of where the plan has it. Where the body
/// goes on being tilted, the plan is turned over the ground by what is too much, and the CoM is
/// where it belongs. Ahead and backward soles are long enough to do without for most of 5 degrees.
namespace verp::balance {

struct LeanState {
  gait::Xy tilt_rad;  ///< about x and y: roll, and pitch off the plan's, without what a step sways
  gait::Xy lean_rad;  ///< about x and y, on top of the plan: against the tilt
  VERP_FIELDS(tilt_rad, lean_rad)
};
VERP_PACKED(LeanState);

/// So much tilt is left: an accelerometer's offset (25 mg), and floors that pass for level.
inline constexpr float kLeftTilted_rad = 0.026F;
/// And so much pitch. Both feet with their toes on an edge of 1 cm tilt generic21 by 0.1 rad: it
/// took itself for falling back, stepped back, and 3 of 40 never got up on it. With this, 80 of 80
/// do; with 0.06 it hurries over and 3 of 80 fall (tuning seeds 1001-1080, 20 s).
inline constexpr float kLeftPitched_rad = 0.08F;

/// Once a tick, of a robot that walks. The planned pitch is the trunk's, nose down positive.
void learn_lean(const AttitudeOut& attitude, float planned_pitch_rad, float period_s,
                LeanState& state);

/// Turns the plan's body about the ground under it.
void lean(const LeanState& state, gait::Posture& posture);

}  // namespace verp::balance
