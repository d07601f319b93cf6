#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/gait.hpp"

/// Keeps the body upright on sloping ground. Legs of equal length hold the body perpendicular to
/// the ground, so across 5 degrees the CoM is 2 cm downhill of its plan. If a tilt lasts, the plan
/// is turned against the excess, which brings the CoM back. Soles are long enough to need little of
/// this along x for most of 5 degrees.
namespace verp::balance {

struct LeanState {
  gait::Xy
      tilt_rad;  ///< about x and y: roll, and pitch relative to the plan, without the sway of steps
  gait::Xy lean_rad;  ///< about x and y, added to the plan against the tilt
  VERP_FIELDS(tilt_rad, lean_rad)
};
VERP_PACKED(LeanState);

/// Tilt that is not corrected: an accelerometer's offset (25 mg) and nearly level floors.
inline constexpr float kLeftTilted_rad = 0.026F;
/// The same for pitch. With both sets of toes on a 1 cm edge generic21 tilts by 0.1 rad; with a
/// smaller limit it stepped back as if falling, and 3 of 40 never got over the edge. With this, 80
/// of 80 do; with 0.06 it hurries and 3 of 80 fall (tuning seeds 1001-1080, 20 s).
inline constexpr float kLeftPitched_rad = 0.08F;

/// Call once a tick while walking. The planned pitch is the trunk's, positive nose down.
void learn_lean(const AttitudeOut& attitude, float planned_pitch_rad, float period_s,
                LeanState& state);

/// Turns the planned body about the ground under it.
void lean(const LeanState& state, gait::Posture& posture);

}  // namespace verp::balance
