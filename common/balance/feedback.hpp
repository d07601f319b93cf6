#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/gait.hpp"
#include "common/model/params.hpp"

/// What ankles and hips add to the plan: gyro and tilt feedback on carrying legs, and a swing foot
/// kept level.
namespace verp::balance {

/// Corrections of one leg's canonical angles, rad.
struct LegCorrection {
  float hip_roll_rad = 0;
  float hip_pitch_rad = 0;
  float ankle_pitch_rad = 0;
  float ankle_roll_rad = 0;
  VERP_FIELDS(hip_roll_rad, hip_pitch_rad, ankle_pitch_rad, ankle_roll_rad)
};
VERP_PACKED(LegCorrection);

struct FeedbackOut {
  LegCorrection leg[kFeet];
  VERP_FIELDS(leg)
};
VERP_PACKED(FeedbackOut);

FeedbackOut feedback(const BalanceTuning& tuning, const AttitudeOut& attitude,
                     float planned_pitch_rad, std::uint8_t swing);

/// Adds corrections to joint angles of one leg (hip to ankle), through the leg's directions.
void add(const LegParams& leg, const LegCorrection& correction, float* leg_rad);

}  // namespace verp::balance
