#pragma once
#include "common/gait/whole_body.hpp"

/// The swing leg turns the robot about the vertical against one sole's friction: at 0.4 m/s the
/// sole slips in every step. Arms swinging the other way cancel the legs' spin
/// (Params::arm_rad_per_m).
namespace verp::balance {

/// Adds the swing to the goals `angle_rad` [joint_count]. Does nothing without arms or if
/// BalanceTuning::arm_swing is 0.
void swing_arms(const Params& params, const BalanceTuning& tuning, const gait::Posture& posture,
                float* angle_rad);

}  // namespace verp::balance
