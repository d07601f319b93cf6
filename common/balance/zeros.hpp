#pragma once
#include "common/balance/attitude.hpp"
#include "common/base/fields.hpp"
#include "common/gait/gait.hpp"
#include "common/kinematics/forward.hpp"

/// Zero errors of the legs. Every encoder is off by a fraction of a degree; over a leg that adds up
/// to a tilted sole, which throws the body to and fro in every step. A single stance foot with the
/// pressure well inside its sole is flat on the ground. The tilt that encoders and IMU then give is
/// the leg's error, and the ankle's goals are corrected by it. Without force cells a single stance
/// foot is assumed flat in the middle of its step.
namespace verp::balance {

/// One leg's sole tilt by its encoders minus the true tilt, in the sole frame.
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

/// True if the centre of the four corner forces lies in the middle half of the sole.
bool stands_flat(const std::uint16_t* foot_count);

/// Learns from this tick's tilt of a flat sole. `leg_rad` are the planned angles of the leg,
/// `chain` its links in the walk frame, `foot` the planned sole. Does nothing if a joint of the leg
/// did not report this tick.
void learn_zero(const Params& params, const LegParams& leg, const kinematics::LegChain& chain,
                const float* leg_rad, const gait::FootPose& foot, const Inputs& inputs,
                const AttitudeOut& attitude, float planned_pitch_rad, LegZero& zero);

/// Corrects a leg's goals so that its sole meets the ground as planned.
void add_zero(const LegParams& leg, const LegZero& zero, float* leg_rad);

}  // namespace verp::balance
