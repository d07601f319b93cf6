#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/gait.hpp"

/// Keeps the body upright on slopes. Equal legs hold it perpendicular to the ground: across 5
/// degrees the CoM is 2 cm downhill. A lasting tilt turns the plan back by its excess. Along x the
/// soles are long enough for most of 5 degrees.
namespace verp::balance {

struct LeanState {
  gait::Xy tilt_rad;  ///< roll, and pitch off the plan, without the steps' sway
  gait::Xy lean_rad;  ///< added to the plan, against the tilt
  VERP_FIELDS(tilt_rad, lean_rad)
};
VERP_PACKED(LeanState);

/// Tilt left uncorrected: accelerometer offset (25 mg), nearly level floors.
inline constexpr float kLeftTilted_rad = 0.026F;
/// The same for pitch. With its toes on a 1 cm edge generic21 tilts by 0.1 rad; it once took that
/// for a fall and stepped back, and 3 of 40 never got over the edge. With this 80 of 80 do; with
/// 0.06 it hurries and 3 of 80 fall (tuning seeds 1001-1080, 20 s).
inline constexpr float kLeftPitched_rad = 0.08F;

/// Once a tick while walking. Planned pitch: the trunk's, nose down positive.
void learn_lean(const AttitudeOut& attitude, float planned_pitch_rad, float period_s,
                LeanState& state);

/// Turns the planned body about the ground below it.
void lean(const LeanState& state, gait::Posture& posture);

}  // namespace verp::balance
