#pragma once
#include "common/gait/whole_body.hpp"

/// Arms swing against the legs. A leg that swings ahead of one that stands turns the robot about
/// the vertical, and only the friction under one sole is there to hold it: at 0.4 m/s it slips in
/// every step, and the robot wanders off its heading. Arms that swing the other way take what the
/// legs turn (Params::arm_rad_per_m, from the masses of both).
namespace verp::balance {

/// Adds the arms' swing to the goals in `angle_rad` [joint_count]: nothing with
/// BalanceTuning::arm_swing 0, without arms, and while the feet stand side by side.
void swing_arms(const Params& params, const BalanceTuning& tuning, const gait::Posture& posture,
                float* angle_rad);

}  // namespace verp::balance
