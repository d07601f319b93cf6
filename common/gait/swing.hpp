#pragma once
#include "common/gait/types.hpp"
#include "common/math/spline.hpp"

/// The feet at any moment of a step: ends and extreme from the plan, splines between them.
namespace verp::gait {

struct FootPose {
  Foothold on;
  float height_m = 0;
};

/// Foot `side` at `time_s` after the beginning of the step. The swing foot leaves when the double
/// support ends, follows a quintic from lift-off to landing (at rest at both, so that nothing
/// jerks) and the quartic through lift-off, apex and landing in height.
inline FootPose foot_at(const Step& step, int side, float time_s) {
  if (side != step.swing) return {step.foot[side], 0.0F};
  const float swing_s = step.duration_s() - step.double_support_s;
  const float v = math::clamp((time_s - step.double_support_s) / swing_s, 0.0F, 1.0F);
  const float share = math::minimum_jerk(v).value;
  const Foothold& from = step.foot[side];
  FootPose pose;
  pose.on.at_m = from.at_m + share * (step.landing.at_m - from.at_m);
  pose.on.yaw_rad = from.yaw_rad + share * (step.landing.yaw_rad - from.yaw_rad);
  pose.height_m = step.lift_m * math::swing_lift(v).value;
  return pose;
}

}  // namespace verp::gait
