#include "common/balance/feedback.hpp"

namespace verp::balance {
namespace {

constexpr float kShareOfTwo = 0.35F;  // with 0.5 some twin robots tremble

}  // namespace

FeedbackOut feedback(const BalanceTuning& tuning, const AttitudeOut& attitude,
                     float planned_pitch_rad, std::uint8_t swing) {
  FeedbackOut out;
  if (!(tuning.feedback_enable > 0.5F)) return out;
  const float pitch_rad = attitude.pitch_rad - planned_pitch_rad;
  // Less with two legs: a stiff robot would tremble.
  const float share = swing == gait::kBoth ? kShareOfTwo : 1.0F;
  const auto law = [&](float tilt_gain, float rate_gain_s, float tilt_rad, float rate_rad_s) {
    return math::clamp(share * (tilt_gain * tilt_rad + rate_gain_s * rate_rad_s),
                       -tuning.feedback_limit_rad, tuning.feedback_limit_rad);
  };
  LegCorrection carrying;
  carrying.hip_roll_rad = law(tuning.hip_roll_tilt, tuning.hip_roll_rate_s, attitude.roll_rad,
                              attitude.roll_rate_rad_s);
  carrying.hip_pitch_rad =
      law(tuning.hip_pitch_tilt, tuning.hip_pitch_rate_s, pitch_rad, attitude.pitch_rate_rad_s);
  carrying.ankle_pitch_rad =
      law(tuning.ankle_pitch_tilt, tuning.ankle_pitch_rate_s, pitch_rad, attitude.pitch_rate_rad_s);
  carrying.ankle_roll_rad = law(tuning.ankle_roll_tilt, tuning.ankle_roll_rate_s, attitude.roll_rad,
                                attitude.roll_rate_rad_s);
  LegCorrection swinging;
  swinging.ankle_pitch_rad = law(-tuning.swing_level, 0.0F, pitch_rad, 0.0F);
  swinging.ankle_roll_rad = law(-tuning.swing_level, 0.0F, attitude.roll_rad, 0.0F);
  for (int side = 0; side < kFeet; ++side) out.leg[side] = side == swing ? swinging : carrying;
  return out;
}

void add(const LegParams& leg, const LegCorrection& correction, float* leg_rad) {
  leg_rad[1] += leg.direction[1] * correction.hip_roll_rad;
  leg_rad[2] += leg.direction[2] * correction.hip_pitch_rad;
  leg_rad[4] += leg.direction[4] * correction.ankle_pitch_rad;
  leg_rad[5] += leg.direction[5] * correction.ankle_roll_rad;
}

}  // namespace verp::balance
