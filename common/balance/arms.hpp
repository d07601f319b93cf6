#pragma once
#include "common/gait/whole_body.hpp"

/// Arm swing. The swing leg turns the robot about the vertical against the friction of one sole: at
/// 0.4 m/s the sole slips in every step and the heading drifts. Arms swinging the other way cancel
/// the legs' spin (Params::arm_rad_per_m, from the masses of both).
namespace verp::balance {

/// Adds the swing to the goals `angle_rad` [joint_count]. Nothing with BalanceTuning::arm_swing 0,
/// without arms, or with feet side by side.
void swing_arms(const Params& params, const BalanceTuning& tuning, const gait::Posture& posture,
                float* angle_rad);

}  // namespace verp::balance
