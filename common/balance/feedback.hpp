#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/gait.hpp"
#include "common/model/params.hpp"

/// Gyro and tilt feedback on ankles and hips of stance legs; keeps a swing foot level.
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

/// Adds the correction to joint angles (hip to ankle), by the leg's directions.
void add(const LegParams& leg, const LegCorrection& correction, float* leg_rad);

}  // namespace verp::balance
