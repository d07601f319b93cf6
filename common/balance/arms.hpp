#pragma once
#include "common/gait/whole_body.hpp"

/// Arms swing against the legs. The swing leg turns the robot about the vertical, and only the
/// friction of the stance sole resists. At 0.4 m/s that sole slips in every step and the robot
/// loses its heading. Arms swinging the other way cancel the legs' spin (Params::arm_rad_per_m,
/// from the masses of both).
namespace verp::balance {

/// Adds the arm swing to the goals in `angle_rad` [joint_count]. Adds nothing if
/// BalanceTuning::arm_swing is 0, without arms, or while the feet are side by side.
void swing_arms(const Params& params, const BalanceTuning& tuning, const gait::Posture& posture,
                float* angle_rad);

}  // namespace verp::balance
