#pragma once
#include "common/gait/types.hpp"
#include "common/math/spline.hpp"
#include "common/math/xyz.hpp"

/// The feet during a step: splines between the plan's ends and extreme.
namespace verp::gait {

struct FootPose {
  Foothold on;
  float height_m = 0;
  Xyz accel_m_s2;  ///< of the sole
};

/// A swing foot's progress from 0 to 1: a quintic at rest at both ends. Haste mixes in a cubic,
/// which needs less servo speed.
inline math::CurvePoint swing_along(float u, float haste) {
  constexpr float kBrisk = 0.24F;  // share of the cubic per unit of haste
  const math::CurvePoint gentle = math::minimum_jerk(u);
  if (haste == 0.0F) return gentle;
  const math::CurvePoint brisk = math::smooth_step(u);
  const float share = kBrisk * haste;
  return {gentle.value + share * (brisk.value - gentle.value),
          gentle.derivative + share * (brisk.derivative - gentle.derivative),
          gentle.second + share * (brisk.second - gentle.second)};
}

/// The swing foot moves from the end of double support to landing. Its height is the rise to
/// touchdown_m plus a quartic through lift-off, apex and landing. The same quartic bends it around
/// the other foot.
inline FootPose foot_at(const Step& step, int side, float time_s) {
  if (side != step.swing) {
    const float settle_s = 2.0F * step.key_s();
    const bool settles = side == step.landed && time_s < settle_s;
    return {step.foot[side], settles ? step.settle_m * (1.0F - time_s / settle_s) : 0.0F, {}};
  }
  const float swing_s = step.duration_s() - step.double_support_s;
  const float v = math::clamp((time_s - step.double_support_s) / swing_s, 0.0F, 1.0F);
  const math::CurvePoint along = swing_along(v, step.haste);
  const math::CurvePoint lift = math::swing_lift(v);
  const Foothold& from = step.foot[side];
  const Xy way_m = step.landing.at_m - from.at_m;
  FootPose pose;
  pose.on.at_m = from.at_m + along.value * way_m + lift.value * step.bend_m;
  pose.on.yaw_rad = from.yaw_rad + along.value * (step.landing.yaw_rad - from.yaw_rad);
  pose.height_m = step.lift_m * lift.value + step.touchdown_m * along.value;
  const float per_s2 = 1.0F / math::square(swing_s);
  const Xy accel = (per_s2 * along.second) * way_m + (per_s2 * lift.second) * step.bend_m;
  pose.accel_m_s2 = {accel.x, accel.y,
                     per_s2 * (lift.second * step.lift_m + along.second * step.touchdown_m)};
  return pose;
}

}  // namespace verp::gait
