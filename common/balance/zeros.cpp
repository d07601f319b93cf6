#include "common/balance/zeros.hpp"

#include "common/model/leg.hpp"

namespace verp::balance {
namespace {

constexpr float kLearning_s = 1.0F;  // averages out sway
constexpr float kMost_rad = 0.05F;   // three zeros a degree off, all one way

}  // namespace

bool stands_flat(const std::uint16_t* foot_count) {
  // Front left, front right, back left, back right. In the middle half, opposite edges differ by
  // less than 3 to 1.
  const std::int32_t front = foot_count[0] + foot_count[1], back = foot_count[2] + foot_count[3];
  const std::int32_t left = foot_count[0] + foot_count[2], right = foot_count[1] + foot_count[3];
  return front < 3 * back && back < 3 * front && left < 3 * right && right < 3 * left;
}

void learn_zero(const Params& params, const LegParams& leg, const kinematics::LegChain& chain,
                const float* leg_rad, const gait::FootPose& foot, const Inputs& inputs,
                const AttitudeOut& attitude, float planned_pitch_rad, LegZero& zero) {
  // Each joint's error turns the sole about its axis.
  gait::Xy turn_rad;
  float seen_rad[kLegJoints];
  if (!model::measure_leg(params, leg, inputs, seen_rad)) return;
  for (int k = 0; k < kLegJoints; ++k) {
    const float off_rad = seen_rad[k] - leg_rad[k];
    const Vec3 axis =
        kinematics::joint_axis(model::joint_of(params, leg, k), chain.link[k].rotation);
    turn_rad = turn_rad + off_rad * gait::Xy{axis.x(), axis.y()};
  }
  const gait::Xy sole_rad = gait::turned(turn_rad, -foot.on.yaw_rad);
  const float share = math::min(1e-6F * static_cast<float>(params.period_us) / kLearning_s, 1.0F);
  const auto learn = [&](float tilt_rad, float& known_rad) {
    known_rad = math::clamp(known_rad + share * (tilt_rad - known_rad), -kMost_rad, kMost_rad);
  };
  learn(attitude.roll_rad + sole_rad.x, zero.roll_rad);
  learn(attitude.pitch_rad - planned_pitch_rad + sole_rad.y, zero.pitch_rad);
}

void add_zero(const LegParams& leg, const LegZero& zero, float* leg_rad) {
  leg_rad[4] += leg.direction[4] * zero.pitch_rad;
  leg_rad[5] += leg.direction[5] * zero.roll_rad;
}

}  // namespace verp::balance
