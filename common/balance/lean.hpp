#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/gait.hpp"

/// Keeps the body upright on slopes: legs alone hold it perpendicular to the ground, with the CoM 2
/// cm downhill across 5 degrees. A lasting tilt turns the plan back by its excess.
namespace verp::balance {

struct LeanState {
  gait::Xy tilt_rad;  ///< roll, and pitch off the plan, without sway
  gait::Xy lean_rad;  ///< added to the plan
  VERP_FIELDS(tilt_rad, lean_rad)
};
VERP_PACKED(LeanState);

/// Tilt left uncorrected: accelerometer offset (25 mg), nearly level floors.
inline constexpr float kLeftTilted_rad = 0.026F;
/// Pitch left uncorrected. With its toes on a 1 cm edge generic21 tilts by 0.1 rad, which is no
/// fall. 80 of 80 get over the edge; with 0.06 3 of 80 fall (tuning seeds 1001-1080, 20 s).
inline constexpr float kLeftPitched_rad = 0.08F;

/// Once a tick while walking. Nose down is positive.
void learn_lean(const AttitudeOut& attitude, float planned_pitch_rad, float period_s,
                LeanState& state);

/// Turns the planned body about the ground below it.
void lean(const LeanState& state, gait::Posture& posture);

}  // namespace verp::balance
