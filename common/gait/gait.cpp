#include "common/gait/gait.hpp"

#include "common/gait/dcm.hpp"
#include "common/math/convert.hpp"
#include "common/model/leg.hpp"
#include "common/record/digest.hpp"

namespace verp::gait {
namespace {

// Least time for a landed foot to take the weight. A jump of goals between two ticks steers the
// feet differently. Tuning seeds 1001-1010, 4 cm in 450 ms: heading error 1.3 degrees rms without,
// 0.9 with it.
constexpr float kTaken_s = 0.008F;

// A moment at most one step back and within stored key points.
struct Moment {
  const Step* step;
  std::int32_t time_us;    // since the step's beginning
  std::uint8_t first_key;  // fixed key point at the step's start
};

Moment moment_before(const GaitState& state, std::int32_t delay_us) {
  constexpr std::int32_t kKept = kFixed - 4;
  const std::int32_t key_us = state.queue[0].key_us;
  const std::int32_t kept_us = kKept * key_us;
  const std::int32_t time_us = state.clock_us - (delay_us < kept_us ? delay_us : kept_us);
  if (time_us >= 0) return {&state.queue[0], time_us, state.first_key};
  const std::int32_t passed = state.clock_us / key_us;
  const std::int32_t earlier_us = state.previous.duration_us() + time_us;
  const std::int32_t oldest_us =
      state.previous.duration_us() - (kKept - passed) * state.previous.key_us;
  return {&state.previous, earlier_us > oldest_us ? earlier_us : oldest_us, state.previous_key};
}

struct Place {
  std::uint8_t index;
  float fraction;
};

Place place_of(const Moment& moment) {
  const std::int32_t key_us = moment.step->key_us;
  const std::int32_t key = moment.time_us > 0 ? moment.time_us / key_us : 0;
  return {static_cast<std::uint8_t>(moment.first_key + key),
          static_cast<float>(moment.time_us - key * key_us) / static_cast<float>(key_us)};
}

Posture posture_at(const Params& params, const Tuning& tuning, const GaitState& state,
                   const Moment& moment) {
  const Place place = place_of(moment);
  const float time_s = static_cast<float>(moment.time_us) * 1e-6F;
  return posture_of(params, tuning.gait, body_at(state.preview, place.index, place.fraction),
                    foot_at(*moment.step, kLeft, time_s), foot_at(*moment.step, kRight, time_s));
}

// Ends the plan at the DCM of walking on or standing; carries it back to the head's step.
void set_dcm_ends(const Params& params, const Tuning& tuning, const VelocityIn& wanted,
                  GaitState& state) {
  Step& last = state.queue[state.queued - 1];
  last.dcm_end_m = last.zmp_end_m;
  if (!last.ends_walk()) {
    // Two more steps, only for the ZMP.
    FootstepState ahead = state.footsteps;
    const Step next = next_footholds(params, tuning.gait, wanted, last, ahead);
    if (next.ends_walk()) {
      last.dcm_end_m = next.zmp_end_m;
    } else {
      const Step second = next_footholds(params, tuning.gait, wanted, next, ahead);
      last.dcm_end_m = periodic_dcm(last, next.zmp_end_m - last.zmp_end_m,
                                    second.zmp_end_m - next.zmp_end_m, state.preview.omega);
    }
  }
  for (int i = state.queued - 2; i >= state.preview.head_step; --i) {
    state.queue[i].dcm_end_m = dcm_at(state.queue[i + 1], state.preview.omega, 0.0F);
  }
}

// Key points that must lie ahead of the clock before a hurried walk begins.
constexpr int kHurry = 2;

// In a hurried start the ZMP throws the resting pendulum to the DCM at the step's end: further out
// in shorter steps, but within the soles.
void throw_body(const Params& params, const GaitTuning& tuning, GaitState& state) {
  constexpr std::uint8_t kShortest = 3;
  Step& step = state.queue[0];
  const LegParams& leg = params.leg[kLeft];
  const float reach_m = tuning.half_stance_m + leg.sole_left_m - tuning.support_margin_m;
  const Xy com_m = state.preview.com_m;
  for (step.key_points = kShortest; step.key_points < kKeyPointsPerStep; ++step.key_points) {
    const float grow = math::exp(state.preview.omega * step.duration_s());
    step.zmp_end_m = com_m - (1.0F / (grow - 1.0F)) * (step.dcm_end_m - com_m);
    if (math::abs(step.zmp_end_m.y) <= reach_m) return;
  }
}

// Plans anew the step beyond the head's: no key point lies in it.
void stop_earlier(const Tuning& tuning, GaitState& state) {
  const Step& last = state.queue[state.queued - 1];
  const bool planned = state.queued >= state.preview.head_step + 2 && last.swing != kBoth;
  if (!planned || last.phase == Phase::kFinal) return;
  take_back(tuning.gait, last, state.footsteps);
  --state.queued;
}

// Keeps a step known beyond the head's.
void extend_queue(const Params& params, const Tuning& tuning, const GaitIn& in, GaitState& state) {
  VelocityIn wanted = in.wanted;
  wanted.stop = wanted.stop || !in.walk || (state.footsteps.notes & kPlanRefused) != 0;
  if (wanted.stop && wanted.quick) stop_earlier(tuning, state);
  while (state.queued < kQueue && state.queued < state.preview.head_step + 2) {
    const Step& last = state.queue[state.queued - 1];
    state.queue[state.queued] = last.ends_walk()
                                    ? rest_step(tuning.gait, last)
                                    : next_step(params, tuning.gait, wanted, last, state.footsteps);
    ++state.queued;
    set_dcm_ends(params, tuning, wanted, state);
    if (state.preview.head == 0 && hurried(state.queue[0])) throw_body(params, tuning.gait, state);
  }
}

// A joint at its limit leaves the sole near its target.
bool reaches(std::uint8_t leg_flags) {
  return (leg_flags & (kinematics::kOutOfReach | kinematics::kNotConverged)) == 0;
}

void shorten(std::uint16_t note, FootstepState& footsteps) {
  constexpr float kLess = 0.01F;
  if (footsteps.scale <= 0.1F) footsteps.notes |= kPlanRefused;
  footsteps.scale = math::max(0.1F, footsteps.scale - kLess);
  footsteps.calm = 0;
  footsteps.notes |= note;
}

// Shortens strides while the ZMP would leave the sole; lengthens them after a cycle with room. The
// multibody correction is linear in misses, so it is trusted with half a sole.
void watch_zmp(const Params& params, const Tuning& tuning, const Step& step, Xy miss_m,
               GaitState& state) {
  if (step.swing == kBoth) return;
  const LegParams& leg = params.leg[step.carrying()];
  const Xy out_m = turned(miss_m, -step.foot[step.carrying()].yaw_rad);
  const float halves = tuning.balance.multibody_enable > 0.5F ? 2.0F : 1.0F;
  const float room_x_m = 0.5F * halves * (leg.sole_front_m + leg.sole_back_m) -
                         math::abs(tuning.gait.zmp_x_m) - tuning.gait.support_margin_m;
  // Without ankle roll the robot rocks over its soles' edges, up to its midline.
  const float rocks_m = model::has(leg, kLegJoints - 1) ? 0.0F : tuning.gait.half_stance_m;
  const float room_y_m = 0.5F * halves * (leg.sole_left_m + leg.sole_right_m) -
                         math::abs(tuning.gait.zmp_y_m) - tuning.gait.support_margin_m + rocks_m;
  const auto within = [&](float share) {
    return math::abs(out_m.x) <= share * room_x_m && math::abs(out_m.y) <= share * room_y_m;
  };
  constexpr float kMore = 1.2F, kCalm = 0.8F;
  static_assert(kMore * kCalm < 1.0F, "what grows must not have to shrink again");
  FootstepState& footsteps = state.footsteps;
  if (!within(kCalm)) footsteps.calm = 0;
  if (!within(1.0F)) {
    shorten(0, footsteps);
  } else if (footsteps.scale < 1.0F && ++footsteps.calm > 2 * kKeyPointsPerStep) {
    footsteps.scale = math::min(1.0F, kMore * footsteps.scale);
    footsteps.calm = 0;
  }
}

void lay_key_points(const Params& params, const Tuning& tuning, const GaitIn& in,
                    GaitState& state) {
  PreviewState& preview = state.preview;
  // Two if a control period may exceed a key point's.
  const int most = in.period_us > state.queue[0].key_us ? 2 : 1;
  for (int i = 0; i < most; ++i) {
    if (static_cast<std::uint8_t>(preview.head - preview.fixed) >= kHorizon) return;
    extend_queue(params, tuning, in, state);
    const Laid laid = lay_key_point(params, tuning, state.queue, preview);
    watch_zmp(params, tuning, state.queue[preview.head_step], laid.zmp_miss_m, state);
    if (!reaches(laid.leg_flags)) shorten(kReachShortened, state.footsteps);
    if (!(tuning.balance.multibody_enable > 0.5F)) {
      preview.ring[static_cast<std::uint8_t>(preview.head - 1) % kRing].zmp_miss_m = Xy{};
    }
  }
}

// Moves the origin once a step, so that roundings do not add up.
void rebase_walk(Xy origin_m, GaitState& state) {
  const auto move_step = [&](Step& step) {
    for (Foothold& foot : step.foot) foot.at_m = foot.at_m - origin_m;
    step.landing.at_m = step.landing.at_m - origin_m;
    step.zmp_begin_m = step.zmp_begin_m - origin_m;
    step.zmp_end_m = step.zmp_end_m - origin_m;
    step.dcm_end_m = step.dcm_end_m - origin_m;
  };
  move_step(state.previous);
  for (Step& step : state.queue) move_step(step);
  state.footsteps.body.at_m = state.footsteps.body.at_m - origin_m;
  rebase(origin_m, state.preview);
}

void next_in_queue(GaitState& state) {
  state.clock_us -= state.queue[0].duration_us();
  state.previous = state.queue[0];
  state.previous_key = state.first_key;
  state.first_key = static_cast<std::uint8_t>(state.first_key + state.previous.key_points);
  for (int i = 0; i + 1 < kQueue; ++i) state.queue[i] = state.queue[i + 1];
  --state.queued;
  --state.preview.head_step;
  const Step& step = state.queue[0];
  if (step.swing != kBoth) rebase_walk(step.foot[step.carrying()].at_m, state);
}

void plan_ahead(const Params& params, const Tuning& tuning, const GaitIn& in, GaitState& state) {
  const Step& step = state.queue[0];
  const auto wanted = static_cast<std::uint8_t>(state.first_key + state.clock_us / step.key_us + 2);
  while (state.moving != 0 && static_cast<std::int8_t>(wanted - state.preview.fixed) > 0) {
    fix_key_point(step, state.preview);
  }
  lay_key_points(params, tuning, in, state);
}

Posture stand_posture(const Params& params, const Tuning& tuning, const Step& stand,
                      const GaitState& state) {
  return posture_of(params, tuning.gait, state.stand_body_m, foot_at(stand, kLeft, 0.0F),
                    foot_at(stand, kRight, 0.0F));
}

Settled digest_stand(const Params& params, const Tuning& tuning, const GaitIn& in,
                     const GaitState& state) {
  record::Digest32 stand(1);
  stand.add_struct(tuning.gait);
  stand.add_struct(state.stand_body_m);
  return {digest_load(params, in.goal_rad), stand.value()};
}

// Moves the body until the CoM is over the soles' middle. Weighs it only when arms, head or tuning
// change.
void stand(const Params& params, const Tuning& tuning, const Step& feet, const GaitIn& in,
           GaitState& state) {
  constexpr float kGlideMS = 0.02F;
  constexpr float kSettledM = 2e-4F;
  constexpr float kCentredM = 1e-6F;  // ten times the sum's rounding
  if (!in.walk) state.footsteps.notes = 0;
  const Settled asked = digest_stand(params, tuning, in, state);
  if (!in.walk && asked == state.settled) return;
  if (in.walk && !(soles_apart_m(params, feet.foot[kLeft], feet.foot[kRight]) > 0.0F)) {
    state.footsteps.notes |= kPlanRefused;
  }
  state.preview.lump = lump_of(params, in.goal_rad);
  const Posture posture = stand_posture(params, tuning, feet, state);
  const Masses masses = weigh(params, state.preview.lump, posture, state.preview.leg_rad);
  if (in.walk && !reaches(masses.leg_flags)) state.footsteps.notes |= kPlanRefused;
  const Xy off_m = feet.zmp_end_m - Xy{masses.com_m.x(), masses.com_m.y()};
  const bool may_walk = (state.footsteps.notes & kPlanRefused) == 0 &&
                        math::abs(off_m.x) < kSettledM && math::abs(off_m.y) < kSettledM;
  if (in.walk && may_walk) {
    state.queue[0] = in.at_once ? hurried_step(params, tuning.gait, state.footsteps)
                                : first_step(params, tuning.gait, state.footsteps);
    state.queued = 1;
    state.previous = feet;
    state.clock_us = 0;
    state.moving = 0;
    state.first_key = 0;
    state.previous_key = static_cast<std::uint8_t>(0 - state.previous.key_points);
    begin(params, posture, masses, feet.zmp_end_m, state.preview);
    return;
  }
  if (math::abs(off_m.x) < kCentredM && math::abs(off_m.y) < kCentredM) {
    state.settled = asked;
    return;
  }
  const float most_m = kGlideMS * 1e-6F * static_cast<float>(in.period_us);
  state.stand_body_m.x += math::clamp(off_m.x, -most_m, most_m);
  state.stand_body_m.y += math::clamp(off_m.y, -most_m, most_m);
}

// The last step's end is the new standing frame.
void end_walk(GaitState& state) {
  const Step& rest = state.queue[0];
  const float yaw_rad = 0.5F * (rest.foot[kLeft].yaw_rad + rest.foot[kRight].yaw_rad);
  const Xy between_m = 0.5F * (rest.foot[kLeft].at_m + rest.foot[kRight].at_m);
  state.stand_body_m = turned(body_at(state.preview, state.first_key, 0.0F) - between_m, -yaw_rad);
  state.queued = 0;
}

void walk(const Params& params, const Tuning& tuning, const GaitIn& in, GaitState& state) {
  if (state.moving != 0) state.clock_us += in.period_us;
  while (state.clock_us >= state.queue[0].duration_us()) {
    next_in_queue(state);
    if (state.queue[0].phase == Phase::kIdle) return end_walk(state);
  }
  if (state.preview.head == (hurried(state.queue[0]) ? kHurry : kHorizon)) state.moving = 1;
  plan_ahead(params, tuning, in, state);
}

float left_share(const Params& params, const Step& step, Xy zmp_m) {
  const Xy right_m = sole_center(params, kRight, step.foot[kRight]);
  const Xy across_m = sole_center(params, kLeft, step.foot[kLeft]) - right_m;
  const float span_m2 = math::max(dot(across_m, across_m), 1e-6F);
  return math::clamp(dot(zmp_m - right_m, across_m) / span_m2, 0.0F, 1.0F);
}

void share_weight(const Params& params, const Step& step, float time_s, GaitOut& out) {
  out.zmp_m = zmp_at(step, time_s);
  const float left = left_share(params, step, out.zmp_m);
  out.carry[kLeft] = left;
  out.carry[kRight] = 1.0F - left;
  if (step.swing == kBoth) return;
  const int carrying = step.carrying();
  float& share = out.carry[carrying];
  if (time_s >= step.double_support_s) share = 1.0F;
  if (step.landed == carrying) share = math::min(share, time_s / kTaken_s);
  out.carry[step.swing] = 1.0F - share;
}

GaitOut at_rest(const Params& params, const Tuning& tuning, const Step& feet,
                const GaitState& state) {
  GaitOut out;
  out.posture = stand_posture(params, tuning, feet, state);
  out.zmp_m = feet.zmp_end_m;
  return out;
}

void report_now(const Tuning& tuning, const GaitState& state, GaitOut& out) {
  const Moment now = moment_before(state, math::to_int32(tuning.gait.look_ahead_s * 1e6F));
  const Step& step = *now.step;
  out.phase = step.phase;
  const std::int32_t support_us = math::to_int32(step.double_support_s * 1e6F);
  out.swing = now.time_us < support_us ? kBoth : step.swing;
  out.carrying = static_cast<std::uint8_t>(step.carrying());
  std::int32_t cycle_us = now.time_us < 0 ? 0 : now.time_us;
  if (step.swing == kRight) cycle_us += step.duration_us();
  out.cycle_state = step.swing == kBoth
                        ? std::uint8_t{0}
                        : static_cast<std::uint8_t>((cycle_us + step.key_us) / (2 * step.key_us));
}

}  // namespace

GaitOut update(const Params& params, const Tuning& tuning, GaitState& state, const GaitIn& in) {
  if (state.queued == 0) {
    const Step feet = standing_feet(params, tuning.gait);
    stand(params, tuning, feet, in, state);
    if (state.queued == 0) return at_rest(params, tuning, feet, state);
  } else {
    walk(params, tuning, in, state);
    if (state.queued == 0) {
      return at_rest(params, tuning, standing_feet(params, tuning.gait), state);
    }
  }
  GaitOut out;
  const Moment goal = moment_before(state, 0);
  const Place place = place_of(goal);
  out.posture = posture_at(params, tuning, state, goal);
  out.accel_m_s2 =
      body_acceleration(state.preview, place.index, place.fraction, goal.step->key_s());
  share_weight(params, state.queue[0], static_cast<float>(state.clock_us) * 1e-6F, out);
  report_now(tuning, state, out);
  return out;
}

Posture posture_before(const Params& params, const Tuning& tuning, const GaitState& state,
                       std::int32_t delay_us) {
  if (state.queued == 0) {
    return stand_posture(params, tuning, standing_feet(params, tuning.gait), state);
  }
  return posture_at(params, tuning, state, moment_before(state, delay_us));
}

}  // namespace verp::gait
