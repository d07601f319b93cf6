#include "common/gait/passing.hpp"

#include "common/gait/swing.hpp"
#include "common/math/spline.hpp"

namespace verp::gait {
namespace {

// Samples are densest in the fast middle; between two a sole approaches by at most half the
// clearance.
constexpr int kLooks = 10;

// Share of the swing at sample `i`.
constexpr float time_of(int i) {
  const float w = 2.0F * static_cast<float>(i) / static_cast<float>(kLooks) - 1.0F;
  return 0.5F + 0.25F * w * (1.0F + w * w);
}

// From the sole frame's origin to the edge.
float reach_m(const LegParams& leg, Xy direction) {
  return direction.x * (direction.x > 0.0F ? leg.sole_front_m : -leg.sole_back_m) +
         direction.y * (direction.y > 0.0F ? leg.sole_left_m : -leg.sole_right_m);
}

}  // namespace

Xy bend_beside(const Params& params, float wanted_m, const Step& step) {
  const Foothold &from = step.foot[step.swing], &carrying = step.foot[step.carrying()];
  const float begin_rad = from.yaw_rad - carrying.yaw_rad;
  const float turn_rad = step.landing.yaw_rad - from.yaw_rad;
  if (from.yaw_rad == carrying.yaw_rad && step.landing.yaw_rad == carrying.yaw_rad) return {};
  // In the stance foot's frame. `out`: sign of y towards the swing foot.
  const LegParams &swinging = params.leg[step.swing], &standing = params.leg[step.carrying()];
  const math::SinCos heading = math::sincos(carrying.yaw_rad);
  const math::SinCos back{-heading.sin, heading.cos};
  const Xy begin_m = turned(from.at_m - carrying.at_m, back);
  const Xy way_m = turned(step.landing.at_m - from.at_m, back);
  const float out = step.swing == kLeft ? 1.0F : -1.0F;
  const float standing_m = reach_m(standing, {0.0F, out});
  const float swinging_m = reach_m(swinging, {0.0F, -out});
  float bend_m = 0.0F;
  for (int i = 1; i < kLooks; ++i) {
    const float v = time_of(i);
    const float along = swing_along(v, step.haste).value;
    const Xy at_m = begin_m + along * way_m;
    const math::SinCos turn = math::sincos(begin_rad + along * turn_rad);
    // Room across a line along either sole; one is enough.
    const Xy beside{-out * turn.sin, out * turn.cos};
    const float room_m =
        out * at_m.y - standing_m - reach_m(swinging, {-out * turn.sin, -out * turn.cos});
    const float other_m = dot(at_m, beside) - swinging_m - reach_m(standing, beside);
    const float short_m =
        math::min(wanted_m - room_m, (wanted_m - other_m) / math::max(turn.cos, 0.1F));
    bend_m = math::max(bend_m, short_m / math::swing_lift(v).value);
  }
  return turned({0.0F, out * bend_m}, heading);
}

}  // namespace verp::gait
