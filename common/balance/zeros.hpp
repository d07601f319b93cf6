#pragma once
#include "common/balance/attitude.hpp"
#include "common/base/fields.hpp"
#include "common/gait/gait.hpp"
#include "common/kinematics/forward.hpp"

/// Zero errors of the legs: fractions of a degree tilt the sole and throw the body to and fro. A
/// single stance foot with the pressure well inside its sole is flat on the ground, so the tilt by
/// encoders and IMU is the leg's error and corrects the ankle's goals. Without force cells it is
/// assumed flat in mid-step.
namespace verp::balance {

/// Sole tilt by the encoders minus the true one, sole frame.
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

/// True if the forces' centre is in the middle half of the sole.
bool stands_flat(const std::uint16_t* foot_count);

/// Call with a flat sole. `leg_rad`: planned angles; `chain`: their links, walk frame; `foot`:
/// planned sole. Nothing if a joint did not report.
void learn_zero(const Params& params, const LegParams& leg, const kinematics::LegChain& chain,
                const float* leg_rad, const gait::FootPose& foot, const Inputs& inputs,
                const AttitudeOut& attitude, float planned_pitch_rad, LegZero& zero);

/// Corrects a leg's goals so that its sole lands as planned.
void add_zero(const LegParams& leg, const LegZero& zero, float* leg_rad);

}  // namespace verp::balance
