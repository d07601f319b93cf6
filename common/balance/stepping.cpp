#include "common/balance/stepping.hpp"

#include "common/gait/dcm.hpp"

namespace verp::balance {
namespace {

using gait::Xy;

// DCM errors left to the ankles, in half soles. generic21 at 4 cm in 450 ms, tuning seed 1001,
// pushed at 16 phases from four sides.
constexpr float kAnkles_x = 0.29F, kAnkles_y = 0.36F;
// Hurried servos lag, and stepping after the lag hurries them more. This many hip heights, per unit
// of haste, are left to the ankles too.
constexpr float kHurry = 0.135F;
// Limits on a foot's offset and its speed, in hip heights over the ankles: generic21's 5 cm and 0.6
// m/s.
constexpr float kFarthest = 0.333F, kPace_per_s = 4.0F;
// Share of the swing at each end with less offset speed: near the ground feet do not move sideways.
constexpr float kBegins = 1.0F / 6.0F;
constexpr float kOver_m = 1e-5F;
// A standing robot steps when the DCM is this far from the soles' middle, in half soles; at the
// edge a step is too late. It takes kSteps steps, and as many after each that moved off its plan by
// more than kStillOff_m.
constexpr float kHeld = 0.8F;
constexpr std::uint32_t kSteps = 4;
constexpr float kStillOff_m = 0.01F;

bool within(Xy by_m, float most_m) {
  return math::abs(by_m.x) < most_m && math::abs(by_m.y) < most_m;
}

float beyond(float value, float free) {
  return value - math::clamp(value, -free, free);
}

// Distance of the soles if the swing foot lands `by_m` off.
float apart_m(const Params& params, const gait::Step& step, Xy by_m) {
  gait::Foothold foot[kFeet] = {step.after(gait::kLeft), step.after(gait::kRight)};
  foot[step.swing].at_m = foot[step.swing].at_m + by_m;
  return gait::soles_apart_m(params, foot[gait::kLeft], foot[gait::kRight]);
}

// DCM error over the stance foot, in the body's axes.
Xy error_of(const Params& params, const SteppingIn& in, const gait::Step& step, float now_s,
            float yaw_rad) {
  const int side = step.carrying();
  const Xy planned_m = gait::dcm_at(step, in.gait->preview.omega, now_s) -
                       gait::sole_center(params, side, step.foot[side]);
  const Xy dcm = dcm_m(*in.estimator);
  const Vec3 sole = sole_m(*in.estimator, side);
  return gait::turned({dcm.x - sole.x(), dcm.y - sole.y()}, -in.heading_rad) -
         gait::turned(planned_m, -yaw_rad);
}

// Landing offset; the soles stay as far apart as in standing.
Xy landing_off(const Params& params, const Tuning& tuning, const SteppingIn& in,
               const gait::Step& step, float now_s, float yaw_rad) {
  const LegParams& leg = params.leg[step.swing];
  const Xy error_m = error_of(params, in, step, now_s, yaw_rad);
  const float most_m = kFarthest * tuning.gait.hip_height_m;
  const float half_x_m = 0.5F * (leg.sole_front_m + leg.sole_back_m);
  const float half_y_m = 0.5F * (leg.sole_left_m + leg.sole_right_m);
  const float hurry_m = kHurry * tuning.gait.hip_height_m * step.haste;
  Xy off_m{math::clamp(beyond(error_m.x, kAnkles_x * half_x_m + hurry_m), -most_m, most_m),
           math::clamp(beyond(error_m.y, kAnkles_y * half_y_m), -most_m, most_m)};
  if (off_m.x == 0.0F && off_m.y == 0.0F) return gait::turned(off_m, yaw_rad);
  const float standing_m = 2.0F * tuning.gait.half_stance_m - params.leg[gait::kLeft].sole_right_m -
                           params.leg[gait::kRight].sole_left_m;
  const float least_m = math::min(apart_m(params, step, Xy{}), standing_m);
  const float short_m = least_m - apart_m(params, step, gait::turned(off_m, yaw_rad));
  if (short_m > 0.0F) off_m.y += step.swing == gait::kLeft ? short_m : -short_m;
  return gait::turned(off_m, yaw_rad);
}

void move_foot(const Tuning& tuning, const gait::Step& step, float time_s, float period_s,
               Xy wanted_m, SteppingState& state) {
  const float swing_s = step.duration_s() - step.double_support_s;
  const float v = math::clamp((time_s - step.double_support_s) / swing_s, 0.0F, 1.0F);
  const float share = math::min(1.0F, math::min(v, 1.0F - v) / kBegins);
  const float most_m = kPace_per_s * tuning.gait.hip_height_m * share * period_s;
  const Xy way_m = wanted_m - state.foot_m;
  const float length_m = math::hypot(way_m.x, way_m.y);
  state.foot_m = length_m > most_m ? state.foot_m + (most_m / length_m) * way_m : wanted_m;
}

// The landed foot becomes the stance foot, on its plan by definition; the rest moves by the
// opposite.
void exchange(const gait::Step& step, SteppingState& state) {
  state.body_m = state.body_m - state.foot_m;
  state.foot_m = step.swing != gait::kBoth ? -1.0F * state.foot_m : Xy{};
  if (state.steps > 0) --state.steps;
  state.swing = step.swing;
}

// The plan's pendulum needs the multibody correction. Delayed joints are not shifted.
bool may_step(const Tuning& tuning) {
  return tuning.balance.feedback_enable > 0.5F && tuning.balance.multibody_enable > 0.5F &&
         tuning.gait.joint_delay_s == 0.0F;
}

// The last step brings the feet together.
bool answers(const Tuning& tuning, const SteppingIn& in) {
  return may_step(tuning) && in.gait->queue[1].swing != gait::kBoth;
}

// True if the DCM leaves the soles ahead or behind. Sideways two soles reach as far as a step could
// help.
bool leaves_soles(const Params& params, const SteppingIn& in) {
  if (in.estimator->blind != 0) return false;
  const LegParams& leg = params.leg[gait::kLeft];
  const Xy dcm = dcm_m(*in.estimator);
  const Vec3 middle_m = 0.5F * (sole_m(*in.estimator, 0) + sole_m(*in.estimator, 1));
  const Xy off_m = gait::turned({dcm.x - middle_m.x(), dcm.y - middle_m.y()}, -in.heading_rad);
  return math::abs(off_m.x) > kHeld * 0.5F * (leg.sole_front_m + leg.sole_back_m);
}

void swing_aside(const Params& params, const Tuning& tuning, const SteppingIn& in, const Mat3& body,
                 SteppingState& state) {
  const gait::Step& step = in.gait->queue[0];
  const float time_s = static_cast<float>(in.gait->clock_us) * 1e-6F;
  const float now_s = time_s - tuning.gait.look_ahead_s;
  Xy wanted_m{};
  if (answers(tuning, in)) {
    // Still in the previous step, or position unknown: keep the offset.
    if (now_s < 0.0F || in.estimator->blind != 0) return;
    wanted_m = landing_off(params, tuning, in, step, now_s, math::atan2(body(1, 0), body(0, 0)));
  }
  move_foot(tuning, step, time_s, in.period_s, wanted_m, state);
}

}  // namespace

void step_aside(const Params& params, const Tuning& tuning, const SteppingIn& in,
                SteppingState& state, gait::GaitOut& plan) {
  const gait::Step stands;
  const gait::Step& step = in.gait->queued > 0 ? in.gait->queue[0] : stands;
  if (step.swing != state.swing) exchange(step, state);
  if (step.swing != gait::kBoth) swing_aside(params, tuning, in, plan.posture.body.rotation, state);
  if (as_planned(state, kOver_m)) {
    state.body_m = Xy{};
    return;
  }
  const float keep = math::exp(-in.gait->preview.omega * in.period_s);
  state.body_m = keep * state.body_m;
  for (int side = 0; side < kFeet; ++side) {
    Xy& at_m = plan.posture.foot[side].on.at_m;
    at_m = at_m - state.body_m;
    if (side == static_cast<int>(state.swing)) at_m = at_m + state.foot_m;
  }
  plan.zmp_m = plan.zmp_m - state.body_m;
}

bool pushed(const Params& params, const Tuning& tuning, const SteppingIn& in,
            SteppingState& state) {
  if (!may_step(tuning)) {
    state.steps = 0;
  } else if (in.gait->queued == 0) {
    state.steps = leaves_soles(params, in) ? kSteps : 0U;
  } else if (state.steps > 0 && math::hypot(state.foot_m.x, state.foot_m.y) > kStillOff_m) {
    state.steps = kSteps - 1U;
  }
  return state.steps > 0;
}

bool as_planned(const SteppingState& state, float most_m) {
  return within(state.body_m, most_m) && within(state.foot_m, most_m);
}

}  // namespace verp::balance
