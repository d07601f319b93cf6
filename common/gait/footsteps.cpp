#include "common/gait/footsteps.hpp"

#include "common/gait/passing.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/math/convert.hpp"

namespace verp::gait {
namespace {

// Room between passing soles. Joint errors, slip and the swing's bend take up to 5 mm. At 3 mm one
// of ten fast curves touched (tuning seeds 1001-1026).
constexpr float kSoleClearance_m = 0.005F;
// Largest outward shift of a turning foot: generic21 needs it for 0.4 rad a step.
constexpr float kMostWider_m = 0.045F;
// Mean swing speed, in hip heights per second, above which servos lag (generic21: 0.4 m/s).
constexpr float kUnhurried_per_s = 2.7F;
// A hurried foot that lands late jolts the robot, so haste lowers its target by the share
// kComesDown per unit, kMostDown at most. Random robots, seeds 1001-1030, 0.25 m/s: CoM velocity
// error 9 % less.
constexpr float kComesDown = 0.45F, kMostDown = 0.25F;
constexpr float kMostHaste = 2.0F;  // 1.2 m/s: beyond any known servo

float outward(int side) {
  return side == kLeft ? 1.0F : -1.0F;
}

Xy center_in_sole(const LegParams& leg) {
  return {0.5F * (leg.sole_front_m - leg.sole_back_m), 0.5F * (leg.sole_left_m - leg.sole_right_m)};
}

Xy middle(const Params& params, const Step& step) {
  return 0.5F * (sole_center(params, kLeft, step.after(kLeft)) +
                 sole_center(params, kRight, step.after(kRight)));
}

// Rounds the duration to whole key points.
void set_times(const GaitTuning& tuning, float duration_s, Step& step) {
  step.key_us = math::to_int32(tuning.cycle_s * 1e6F) / (2 * kKeyPointsPerStep);
  step.key_us = step.key_us < 1 ? 1 : step.key_us;
  const float points = duration_s * 1e6F / static_cast<float>(step.key_us);
  // Shorter steps would not cover the head's horizon.
  step.key_points =
      math::to_uint8(math::clamp(points, static_cast<float>(kKeyPointsPerStep), 250.0F));
}

// If all soles landed at the same moment of a control period, the gyro's samples of the jolts would
// add up to a false turn: 3 degrees a minute in a cycle of 45 periods. So every fourth step is half
// a period longer, then shorter. Without steering by heading all steps are equal.
void shift_in_period(const Params& params, const GaitTuning& tuning, FootstepState& state,
                     Step& step) {
  if (!(tuning.heading_gain > 0.0F)) return;
  state.made = (state.made + 1) & 7;
  const std::int32_t half_us = static_cast<std::int32_t>(params.period_us / 2);
  if (state.made == 4) step.key_us += half_us / step.key_points;
  if (state.made == 0) step.key_us -= half_us / step.key_points;
}

void set_haste(const GaitTuning& tuning, Step& step) {
  const Xy way_m = step.landing.at_m - step.foot[step.swing].at_m;
  const float unhurried_m_s = kUnhurried_per_s * tuning.hip_height_m;
  const float speed_m_s = math::hypot(way_m.x, way_m.y) / step.duration_s();
  step.haste = math::clamp(speed_m_s / unhurried_m_s - 1.0F, 0.0F, kMostHaste);
  step.lift_m = tuning.lift_m + tuning.haste_lift_m * step.haste;
  step.touchdown_m = (1.0F - math::min(kComesDown * step.haste, kMostDown)) * tuning.touchdown_m;
}

float toward(float from, float to, float most) {
  return from + math::clamp(to - from, -most, most);
}

// Sideways or turning, the leading foot takes the whole way, the other closes up.
bool leads(int swing, float value) {
  return (swing == kLeft) == (value > 0.0F);
}

// Sideways, the leading foot takes both steps.
float length_of(const Stride& stride) {
  return math::hypot(stride.by_m.x, 2.0F * stride.by_m.y);
}

Stride shortened(Stride stride, float most_m) {
  const float length_m = length_of(stride);
  if (length_m > most_m) stride.by_m = (most_m / length_m) * stride.by_m;
  return stride;
}

Stride wanted_stride(const GaitTuning& tuning, const VelocityIn& wanted, float reach_m,
                     FootstepState& state) {
  const float step_s = 0.5F * tuning.cycle_s;
  Stride stride;
  if (wanted.stop) return stride;
  stride.by_m = {wanted.vx_m_s * step_s, wanted.vy_m_s * step_s};
  stride.turn_rad = wanted.wz_rad_s * step_s + tuning.heading_gain * wanted.heading_error_rad;
  if (length_of(stride) > tuning.max_step_m || math::abs(stride.turn_rad) > tuning.max_turn_rad) {
    state.notes |= kStrideLimited;
  }
  if (state.scale < 1.0F) state.notes |= kZmpShortened;
  stride = shortened(stride, tuning.max_step_m);
  stride.by_m = state.scale * stride.by_m;
  if (length_of(stride) > reach_m) state.notes |= kReachShortened;
  stride.turn_rad = math::clamp(stride.turn_rad, -tuning.max_turn_rad, tuning.max_turn_rad);
  return shortened(stride, reach_m);
}

// Longest step within the leg's reach (Pythagoras).
float reach_limit_m(const Params& params, const GaitTuning& tuning) {
  const LegParams& leg = params.leg[kLeft];
  const float usable_m = kinematics::usable_reach_m(leg);
  const float room_m2 = math::square(usable_m) - math::square(tuning.hip_height_m);
  return room_m2 > 0.0F ? 1.6F * math::sqrt(room_m2) : 0.0F;
}

Foothold landing_of(const GaitTuning& tuning, int swing, const Stride& stride,
                    FootstepState& state) {
  const Xy by_m{stride.by_m.x, leads(swing, stride.by_m.y) ? 2.0F * stride.by_m.y : 0.0F};
  state.body.at_m = state.body.at_m + turned(by_m, state.body.yaw_rad);
  state.body.yaw_rad += leads(swing, stride.turn_rad) ? 2.0F * stride.turn_rad : 0.0F;
  const Xy side_m{0.0F, outward(swing) * tuning.half_stance_m};
  return {state.body.at_m + turned(side_m, state.body.yaw_rad), state.body.yaw_rad};
}

// One sole on the ground, with its heading's sine and cosine.
struct Sole {
  Sole(const Params& params, int side, const Foothold& foot)
      : leg(params.leg[side]), at_m(foot.at_m), heading(math::sincos(foot.yaw_rad)) {}
  const LegParams& leg;
  Xy at_m;
  math::SinCos heading;
};

Xy leftward_of(const Sole& sole) {
  return turned({0.0F, 1.0F}, sole.heading);
}

// From the sole frame's origin to the edge.
float extent_m(const Sole& sole, Xy direction) {
  const LegParams& leg = sole.leg;
  const Xy in_sole = turned(direction, {-sole.heading.sin, sole.heading.cos});
  return in_sole.x * (in_sole.x > 0.0F ? leg.sole_front_m : -leg.sole_back_m) +
         in_sole.y * (in_sole.y > 0.0F ? leg.sole_left_m : -leg.sole_right_m);
}

// Between the soles, across a line whose left is `leftward`.
float room_m(const Sole& left, const Sole& right, Xy leftward) {
  return dot(left.at_m - right.at_m, leftward) - extent_m(left, -1.0F * leftward) -
         extent_m(right, leftward);
}

float clearance_m(const Params& params, const GaitTuning& tuning) {
  const float standing_m =
      2.0F * tuning.half_stance_m - params.leg[kLeft].sole_right_m - params.leg[kRight].sole_left_m;
  return math::min(kSoleClearance_m, standing_m);
}

// How much further out the swing foot must land to clear the stance sole.
float short_of_m(const Params& params, const GaitTuning& tuning, const Step& step, float yaw_rad) {
  const Sole left(params, kLeft, step.after(kLeft)), right(params, kRight, step.after(kRight));
  const float wanted_m = clearance_m(params, tuning);
  const Xy outward = turned({0.0F, 1.0F}, yaw_rad);
  float short_m = kMostWider_m + 1.0F;
  for (const Sole* side : {&left, &right}) {
    const Xy leftward = leftward_of(*side);
    const float gain = dot(outward, leftward);
    if (gain < 0.5F) continue;
    short_m = math::min(short_m, (wanted_m - room_m(left, right, leftward)) / gain);
  }
  return short_m;
}

// Lands the swing foot, further out if soles come too near; false if too far.
bool land(const Params& params, const GaitTuning& tuning, const Stride& stride,
          FootstepState& state, Step& step) {
  step.landing = landing_of(tuning, step.swing, stride, state);
  const float short_m = short_of_m(params, tuning, step, state.body.yaw_rad);
  if (short_m <= 0.0F) return true;
  state.notes |= kStepWidened;
  const Xy out_m{0.0F, outward(step.swing) * short_m};
  step.landing.at_m = step.landing.at_m + turned(out_m, state.body.yaw_rad);
  return short_m <= kMostWider_m;
}

// Turns less where wider steps do not suffice.
void land_beside(const Params& params, const GaitTuning& tuning, Stride& stride,
                 FootstepState& state, Step& step) {
  constexpr int kHalvings = 5;
  const FootstepState before = state;
  if (!(clearance_m(params, tuning) > 0.0F)) state.notes |= kPlanRefused;
  if (land(params, tuning, stride, state, step)) return;
  float enough = 0, too_much = 1;
  const float wanted_rad = stride.turn_rad;
  for (int i = 0; i <= kHalvings; ++i) {
    const float share = i < kHalvings ? 0.5F * (enough + too_much) : enough;
    state.body = before.body;
    stride.turn_rad = share * wanted_rad;
    (land(params, tuning, stride, state, step) ? enough : too_much) = share;
  }
  state.notes |= kTurnShortened;
}

bool side_by_side(const GaitTuning& tuning, const Step& last) {
  const Foothold left = last.after(kLeft), right = last.after(kRight);
  const float apart_m = dot(left.at_m - right.at_m, turned({0.0F, 1.0F}, left.yaw_rad));
  return math::abs(apart_m - 2.0F * tuning.half_stance_m) < 1e-4F;
}

bool still(const Stride& stride) {
  return stride.by_m.x == 0.0F && stride.by_m.y == 0.0F && stride.turn_rad == 0.0F;
}

Step standing_step(const GaitTuning& tuning, const Step& last, Phase phase) {
  Step step;
  set_times(tuning, tuning.start_s, step);
  step.phase = phase;
  step.foot[kLeft] = last.after(kLeft);
  step.foot[kRight] = last.after(kRight);
  step.landing = step.foot[kLeft];
  step.landed = last.swing;
  step.settle_m = last.touchdown_m;
  step.double_support_s = step.duration_s();
  step.zmp_begin_m = last.zmp_end_m;
  step.zmp_end_m = last.zmp_end_m;
  step.dcm_end_m = step.zmp_end_m;
  return step;
}

}  // namespace

float soles_apart_m(const Params& params, const Foothold& left, const Foothold& right) {
  const Sole l(params, kLeft, left), r(params, kRight, right);
  return math::max(room_m(l, r, leftward_of(l)), room_m(l, r, leftward_of(r)));
}

Xy sole_center(const Params& params, int side, const Foothold& foot) {
  return foot.at_m + turned(center_in_sole(params.leg[side]), foot.yaw_rad);
}

Xy zmp_under(const Params& params, const GaitTuning& tuning, int side, const Foothold& foot) {
  const LegParams& leg = params.leg[side];
  const float half_x_m = 0.5F * (leg.sole_front_m + leg.sole_back_m) - tuning.support_margin_m;
  const float half_y_m = 0.5F * (leg.sole_left_m + leg.sole_right_m) - tuning.support_margin_m;
  const Xy offset{math::clamp(tuning.zmp_x_m, -half_x_m, half_x_m),
                  math::clamp(outward(side) * tuning.zmp_y_m, -half_y_m, half_y_m)};
  return foot.at_m + turned(center_in_sole(leg) + offset, foot.yaw_rad);
}

Step standing_feet(const Params& params, const GaitTuning& tuning) {
  Step stand;
  stand.foot[kLeft].at_m = {0.0F, tuning.half_stance_m};
  stand.foot[kRight].at_m = {0.0F, -tuning.half_stance_m};
  stand.landing = stand.foot[kLeft];
  stand.zmp_end_m = middle(params, stand);
  return standing_step(tuning, stand, Phase::kIdle);
}

Step first_step(const Params& params, const GaitTuning& tuning, FootstepState& state) {
  state = FootstepState{};
  Step step = standing_feet(params, tuning);
  step.phase = Phase::kStart;
  step.zmp_end_m = zmp_under(params, tuning, kRight, step.foot[kRight]);
  return step;
}

Step hurried_step(const Params& params, const GaitTuning& tuning, FootstepState& state) {
  Step step = first_step(params, tuning, state);
  step.double_support_s = 0.0F;
  return step;
}

Step rest_step(const GaitTuning& tuning, const Step& last) {
  return standing_step(tuning, last, Phase::kIdle);
}

Step next_footholds(const Params& params, const GaitTuning& tuning, const VelocityIn& wanted,
                    const Step& last, FootstepState& state) {
  const bool walked = last.swing != kBoth;
  if (wanted.stop && walked && still(state.stride) && side_by_side(tuning, last)) {
    Step step = standing_step(tuning, last, Phase::kFinal);
    step.zmp_end_m = middle(params, step);
    step.dcm_end_m = step.zmp_end_m;
    return step;
  }

  const float reach_m = reach_limit_m(params, tuning);
  const Stride goal = wanted_stride(tuning, wanted, reach_m, state);
  const bool quick = wanted.stop && wanted.quick;
  const float most_m = quick ? tuning.max_step_m : tuning.step_change_m;
  const float most_rad = (quick ? 1.0F : 0.25F) * tuning.max_turn_rad;
  Stride stride{{toward(state.stride.by_m.x, goal.by_m.x, most_m),
                 toward(state.stride.by_m.y, goal.by_m.y, most_m)},
                toward(state.stride.turn_rad, goal.turn_rad, most_rad)};
  const bool reached = stride.by_m.x == goal.by_m.x && stride.by_m.y == goal.by_m.y;
  // Between two directions a stride may exceed both.
  if (!reached) stride = shortened(stride, math::min(tuning.max_step_m, reach_m));

  Step step;
  set_times(tuning, 0.5F * tuning.cycle_s, step);
  shift_in_period(params, tuning, state, step);
  step.swing = last.swing == kLeft ? kRight : kLeft;
  step.phase = wanted.stop                                   ? Phase::kFinal
               : last.phase == Phase::kTransition || reached ? Phase::kTransition
                                                             : Phase::kStart;
  step.double_support_s = walked ? tuning.double_support * step.duration_s() : 0.0F;
  step.landed = last.swing;
  step.settle_m = last.touchdown_m;
  step.foot[kLeft] = last.after(kLeft);
  step.foot[kRight] = last.after(kRight);
  land_beside(params, tuning, stride, state, step);
  set_haste(tuning, step);
  state.stride = stride;
  const int carrying = step.carrying();
  step.zmp_begin_m = last.zmp_end_m;
  step.zmp_end_m = zmp_under(params, tuning, carrying, step.foot[carrying]);
  return step;
}

void take_back(const GaitTuning& tuning, const Step& last, FootstepState& state) {
  const Stride& stride = state.stride;
  const Xy by_m{stride.by_m.x, leads(last.swing, stride.by_m.y) ? 2.0F * stride.by_m.y : 0.0F};
  state.body.yaw_rad -= leads(last.swing, stride.turn_rad) ? 2.0F * stride.turn_rad : 0.0F;
  state.body.at_m = state.body.at_m - turned(by_m, state.body.yaw_rad);
  if (tuning.heading_gain > 0.0F) state.made = (state.made - 1) & 7;
}

Step next_step(const Params& params, const GaitTuning& tuning, const VelocityIn& wanted,
               const Step& last, FootstepState& state) {
  Step step = next_footholds(params, tuning, wanted, last, state);
  if (step.swing != kBoth) step.bend_m = bend_beside(params, clearance_m(params, tuning), step);
  return step;
}

}  // namespace verp::gait
