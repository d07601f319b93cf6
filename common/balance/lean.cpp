#include "common/balance/lean.hpp"

namespace verp::balance {
namespace {

constexpr float kMeanTilt_s = 1.0F;    // a few steps
constexpr float kLeans_s = 1.5F;       // slower than the mean, to avoid oscillation
constexpr float kMostLean_rad = 0.1F;  // 5 degrees of ground, and accelerometer offset

void learn_about(float now_rad, float left_rad, float period_s, float& tilt_rad, float& lean_rad) {
  tilt_rad += period_s / kMeanTilt_s * (now_rad - tilt_rad);
  const float slope_rad = tilt_rad - lean_rad;  // tilt without the lean
  const float wanted_rad = math::clamp(slope_rad, -left_rad, left_rad) - slope_rad;
  lean_rad += period_s / kLeans_s * (wanted_rad - lean_rad);
  lean_rad = math::clamp(lean_rad, -kMostLean_rad, kMostLean_rad);
}

}  // namespace

void learn_lean(const AttitudeOut& attitude, float planned_pitch_rad, float period_s,
                LeanState& state) {
  learn_about(attitude.roll_rad, kLeftTilted_rad, period_s, state.tilt_rad.x, state.lean_rad.x);
  learn_about(attitude.pitch_rad - planned_pitch_rad, kLeftPitched_rad, period_s, state.tilt_rad.y,
              state.lean_rad.y);
}

void lean(const LeanState& state, gait::Posture& posture) {
  const gait::Xy lean_rad = state.lean_rad;
  if (lean_rad.x == 0.0F && lean_rad.y == 0.0F) return;
  Pose& body = posture.body;
  const Vec3 way_m = body.position_m.z() * (body.rotation * Vec3(lean_rad.y, -lean_rad.x, 0));
  body.position_m.x() += way_m.x();
  body.position_m.y() += way_m.y();
  body.rotation = body.rotation * (math::rot_x(lean_rad.x) * math::rot_y(lean_rad.y));
}

}  // namespace verp::balance
