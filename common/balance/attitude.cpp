#include "common/balance/attitude.hpp"

namespace verp::balance {
namespace {

constexpr float kLeastLevel2 = 0.01F;  // x axis nearly vertical: no heading
// After a rise the joints still settle by 0.3 degrees, which would look like a bias. Tuning seeds
// 1001-1010, 60 s at 4 cm: heading error 0.6 degrees rms, 0.9 with 0.35 s.
constexpr float kSettle_s = 1.2F;
// Per axis: above a MEMS gyro's bias (ICM-20648 data sheet: 5 deg/s), below real motion.
constexpr float kStillRate_rad_s = 0.12F;
// Clamps readings, so that a wrong one cannot end the calibration.
constexpr float kMostOfOne_rad_s = 2.0F * kStillRate_rad_s;
// Longer than the trembling of hunting servos (5 Hz and above), shorter than a person's turn of the
// robot.
constexpr float kTremble_s = 0.25F;

// More is shaking: mean square over all axes of the clamped readings.
constexpr float kMostShake_rad2_s2 = 0.045F;

Vec3 clamped(const Vec3& rate_rad_s) {
  Vec3 out = rate_rad_s;
  for (int axis = 0; axis < 3; ++axis) {
    out(axis) = math::clamp(out(axis), -kMostOfOne_rad_s, kMostOfOne_rad_s);
  }
  return out;
}

bool within(const Vec3& rate_rad_s, float most_rad_s) {
  const float larger_rad_s = math::max(math::abs(rate_rad_s.x()), math::abs(rate_rad_s.y()));
  return math::max(larger_rad_s, math::abs(rate_rad_s.z())) <= most_rad_s;
}

void learn_bias(AttitudeState& state, const AttitudeIn& in) {
  const Vec3 rate = clamped(in.gyro_body_rad_s);
  const Vec3 before = math::to_vec(state.slow_rad_s);
  const float fade = in.period_s / (kTremble_s + in.period_s);
  const Vec3 slow = before + fade * (rate - before);
  state.slow_rad_s = math::to_xyz(slow);
  state.shake_rad2_s2 += fade * ((rate - slow).squaredNorm() - state.shake_rad2_s2);
  // Tests the raw rate: a wrong bias must not hide stillness.
  const bool calibrated = state.still_s >= kCalibrated_s;
  if (!in.standing || !within(slow, kStillRate_rad_s) || state.shake_rad2_s2 > kMostShake_rad2_s2) {
    if (calibrated) return;
    state.still_s = 0;  // moved or rising: start over
    state.gyro_bias_rad_s = {};
    return;
  }
  // A motion's first readings come before it is detected.
  if (calibrated && !within(rate, kStillRate_rad_s)) return;
  // Mean while still, then slow tracking of warm-up drift.
  const float meant_s = math::max(state.still_s - kSettle_s, 0.0F);
  const float share = in.period_s / (meant_s + in.period_s);
  const Vec3 bias = math::to_vec(state.gyro_bias_rad_s);
  state.gyro_bias_rad_s = math::to_xyz(bias + share * (rate - bias));
  state.still_s = math::min(state.still_s + in.period_s, kBestKnown_s);
}

// The pull is linear in the acceleration: over a step its motion part averages to zero and its
// direction does not.
Vec3 follow(Xyz& up_body, const Vec3& rate_rad_s, const Vec3& accel_m_s2, float period_s,
            float mean_s) {
  Vec3 up = math::to_vec(up_body);
  up -= period_s * math::cross(rate_rad_s, up);
  up += (period_s / mean_s) * (accel_m_s2 / math::kGravityMS2 - up);
  up = math::normalized_or(up, Vec3(0, 0, 1));
  up_body = math::to_xyz(up);
  return up;
}

}  // namespace

AttitudeOut update(AttitudeState& state, const AttitudeIn& in) {
  AttitudeOut out;
  Vec3 up = math::to_vec(state.up_body);
  if (in.fresh) {
    learn_bias(state, in);
    const Vec3 rate = in.gyro_body_rad_s - math::to_vec(state.gyro_bias_rad_s);
    if (in.anew) state.mean_s = 0;
    state.mean_s = math::min(state.mean_s + in.period_s, kHeadingTime_s);
    up = follow(state.up_body, rate, in.accel_body_m_s2, in.period_s,
                math::min(state.mean_s, kAccelTime_s));
    const Vec3 before = math::to_vec(state.slow_up_body);
    const Vec3 after =
        follow(state.slow_up_body, rate, in.accel_body_m_s2, in.period_s, state.mean_s);
    const Vec3 slow = 0.5F * (before + after);  // at the gyro reading
    // Turn of the body's x axis on the ground. The rate about the vertical would turn falsely while
    // the body sways about two axes (coning).
    const float level2 = math::max(slow.y() * slow.y() + slow.z() * slow.z(), kLeastLevel2);
    const float turn_rad_s = (rate.y() * slow.y() + rate.z() * slow.z()) / level2;
    state.heading_rad = math::wrap_angle(state.heading_rad + in.period_s * turn_rad_s);
    out.roll_rate_rad_s = rate.x();
    out.pitch_rate_rad_s = rate.y();
  }
  out.roll_rad = math::atan2(up.y(), up.z());
  out.pitch_rad = math::atan2(-up.x(), math::hypot(up.y(), up.z()));
  out.heading_rad = state.heading_rad;
  out.up = up.z();
  out.calibrated = state.still_s >= kCalibrated_s;
  return out;
}

}  // namespace verp::balance
