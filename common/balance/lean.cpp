#include "common/balance/lean.hpp"

namespace verp::balance {
namespace {

constexpr float kMeanTilt_s = 1.0F;    // some steps
constexpr float kLeans_s = 1.5F;       // slower than the mean, lest they rock each other
constexpr float kMostLean_rad = 0.1F;  // 5 degrees of ground, and an accelerometer's offset

}  // namespace

void learn_lean(const AttitudeOut& attitude, float period_s, LeanState& state) {
  state.tilt_rad += period_s / kMeanTilt_s * (attitude.roll_rad - state.tilt_rad);
  const float free_rad = math::clamp(state.tilt_rad, -kLeftTilted_rad, kLeftTilted_rad);
  const float lean_rad = state.lean_rad - period_s / kLeans_s * (state.tilt_rad - free_rad);
  state.lean_rad = math::clamp(lean_rad, -kMostLean_rad, kMostLean_rad);
}

void lean(const LeanState& state, gait::Posture& posture) {
  if (state.lean_rad == 0.0F) return;
  Pose& body = posture.body;
  const Mat3 turn = math::rot_x(state.lean_rad);
  const Vec3 left = body.rotation * Vec3(0, 1, 0);
  const float aside_m = -state.lean_rad * body.position_m.z();
  body.position_m.x() += aside_m * left.x();
  body.position_m.y() += aside_m * left.y();
  body.rotation = body.rotation * turn;
}

}  // namespace verp::balance
