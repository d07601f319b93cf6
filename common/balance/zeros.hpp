#pragma once
#include "common/balance/attitude.hpp"
#include "common/base/fields.hpp"
#include "common/gait/gait.hpp"
#include "common/kinematics/forward.hpp"

/// Zero errors of the legs. Every encoder is a fraction of a degree off; over a leg that adds up to
/// a sole set down tilted, which throws the body to and fro in every step. A foot that carries
/// alone, with the pressure well inside its sole, stands flat on the ground: what encoders and IMU
/// then make of its tilt is the leg's error, and the ankle's goals move by as much. Without force
/// cells a foot that carries alone is trusted to stand flat in the middle of its step.
namespace verp::balance {

/// Of one leg: the sole's tilt by its encoders less its true one, in the sole frame.
struct LegZero {
  float roll_rad = 0;
  float pitch_rad = 0;
  VERP_FIELDS(roll_rad, pitch_rad)
};
VERP_PACKED(LegZero);

struct ZeroState {
  LegZero leg[kFeet];
  VERP_FIELDS(leg)
};
VERP_PACKED(ZeroState);

/// True if the four corner forces push, and push at a point in the middle half of the sole.
bool stands_flat(const std::uint16_t* foot_count);

/// Takes this tick's tilt of a sole that stands flat. `leg_rad` are the planned angles of the leg
/// and `chain` their links in the walk frame; `foot` is the planned sole. Does nothing if a joint
/// of the leg has not reported in this tick.
void learn_zero(const Params& params, const LegParams& leg, const kinematics::LegChain& chain,
                const float* leg_rad, const gait::FootPose& foot, const Inputs& inputs,
                const AttitudeOut& attitude, float planned_pitch_rad, LegZero& zero);

/// Moves a leg's goals so that its sole meets the ground as planned.
void add_zero(const LegParams& leg, const LegZero& zero, float* leg_rad);

}  // namespace verp::balance
