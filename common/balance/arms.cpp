#include "common/balance/arms.hpp"

namespace verp::balance {
namespace {

// about as far as a person's; sole friction holds the rest
constexpr float kFarthest_rad = 0.6F;

}  // namespace

void swing_arms(const Params& params, const BalanceTuning& tuning, const gait::Posture& posture,
                float* angle_rad) {
  const gait::Xy between_m = posture.foot[gait::kLeft].on.at_m - posture.foot[gait::kRight].on.at_m;
  // The body's x axis on the ground, shortened by cos(trunk pitch).
  const Vec3 ahead = posture.body.rotation.col(0);
  const float ahead_m = between_m.x * ahead.x() + between_m.y * ahead.y();
  for (int side = 0; side < kFeet; ++side) {
    if (params.arm[side] >= params.joint_count) continue;
    angle_rad[params.arm[side]] += math::clamp(
        tuning.arm_swing * params.arm_rad_per_m[side] * ahead_m, -kFarthest_rad, kFarthest_rad);
  }
}

}  // namespace verp::balance
