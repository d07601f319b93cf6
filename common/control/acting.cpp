#include "common/control/acting.hpp"

#include "common/control/falling.hpp"
#include "common/kinematics/forward.hpp"
#include "common/math/convert.hpp"
#include "common/model/coupling.hpp"
#include "common/model/leg.hpp"
#include "common/model/tree.hpp"

namespace verp::control {
namespace {

using safety::Mode;

constexpr float kPressed_n = 2.0F;  // more than an unloaded cell reports

bool plays(Mode mode) {
  return mode == Mode::kActing || mode == Mode::kFalling || mode == Mode::kGettingUp ||
         mode == Mode::kLyingDown;
}

// A stop leaves by the exit. The actions of a fall and of lying down cannot be stopped.
bool shall_stop(const State& state, const Inputs& inputs, const AdmitOut& admitted) {
  constexpr std::uint32_t kNoMore = safety::kAskRelax | safety::kOperatorQuiet | safety::kTrouble;
  if (state.machine.mode == Mode::kFalling || state.machine.mode == Mode::kLyingDown) return false;
  const bool another = state.machine.mode == Mode::kActing && inputs.action != state.action.number;
  return another || (admitted.conditions & kNoMore) != 0 ||
         (state.machine.faults & safety::kTroubleFaults) != 0;
}

// Without sensors, a foot is assumed to be where the action wants it.
bool is_pressed(const Params& params, const Inputs& inputs, int side) {
  if (params.feet.device_id[side] == 0) return true;
  std::int32_t sum = 0;
  for (const std::uint16_t count : inputs.foot_count[side]) sum += count;
  return params.feet.newton_per_count * math::to_float(sum) > kPressed_n;
}

action::PlayerOut play(const Params& params, const action::Library& actions, State& state,
                       const Inputs& inputs, const AdmitOut& admitted,
                       const balance::AttitudeOut& attitude, const Wanted& wanted) {
  action::PlayerIn in;
  in.asked = inputs.action;
  const bool enters = state.machine.in_mode_us == 0;
  in.may_begin = enters && state.machine.mode == Mode::kActing;
  if (enters) in.begin = own_action(actions, state);
  in.from_rad = state.limit.goal_rad;
  in.stop = shall_stop(state, inputs, admitted);
  in.period_us = static_cast<std::int32_t>(params.period_us);
  in.stand_rad = wanted.plain_rad;
  in.roll_rad = attitude.roll_rad;
  in.pitch_rad = attitude.pitch_rad;
  in.up = attitude.up;
  for (int side = 0; side < kFeet; ++side) in.pressed[side] = is_pressed(params, inputs, side);
  return action::update(params, actions, state.action, in);
}

// Both legs of the action's pose, body frame.
struct Legs {
  kinematics::LegChain chain[kFeet];
  Vec3 up[kFeet];      ///< of each sole
  Vec3 sole_m[kFeet];  ///< middle of each
};

Legs legs_of(const Params& params, const float* angle_rad) {
  Legs legs;
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params.leg[side];
    float leg_rad[kLegJoints];
    model::read_leg(leg, angle_rad, leg_rad);
    legs.chain[side] = kinematics::leg_chain(params, leg, Pose{}, leg_rad);
    const Pose sole = kinematics::sole_pose(leg, legs.chain[side]);
    legs.up[side] = sole.rotation.col(2);
    const Vec3 middle_m{0.5F * (leg.sole_front_m - leg.sole_back_m),
                        0.5F * (leg.sole_left_m - leg.sole_right_m), 0};
    legs.sole_m[side] = math::apply(sole, middle_m);
  }
  return legs;
}

// Only the lean beyond the action's is an error.
balance::FeedbackOut keep_up(const BalanceTuning& tuning, const Vec3& up,
                             const action::PlayerOut& played,
                             const balance::AttitudeOut& attitude) {
  balance::AttitudeOut rest = attitude;
  rest.roll_rad -= math::atan2(up.y(), up.z());
  const float pitch_rad = math::atan2(-up.x(), math::hypot(up.y(), up.z()));
  const auto swing = played.stance == action::Stance::kLeft    ? gait::kRight
                     : played.stance == action::Stance::kRight ? gait::kLeft
                                                               : gait::kBoth;
  return balance::feedback(tuning, rest, pitch_rad, swing);
}

// Separate to save stack: the centre of mass takes 1.6 KB before these chains exist.
[[gnu::noinline]] void balance_legs(const Params& params, const action::PlayerOut& played,
                                    const balance::AttitudeOut& attitude, const Vec3& com_m,
                                    State& state, float* goal_rad) {
  const Tuning& tuning = state.tuning;
  const Legs legs = legs_of(params, goal_rad);
  const Vec3 up = math::normalized_or(played.carry[0] * legs.up[0] + played.carry[1] * legs.up[1],
                                      Vec3(0, 0, 1));
  state.feedback = keep_up(tuning.balance, up, played, attitude);
  const Vec3 lift = math::kGravityMS2 * up;
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params.leg[side];
    const Vec3 below_m = com_m - (com_m - legs.sole_m[side]).dot(up) * up;
    const Vec3 off_m = below_m - legs.sole_m[side];
    const float most_m = 0.5F * (leg.sole_left_m + leg.sole_right_m);
    const float far_m = math::sqrt(off_m.squaredNorm());
    const Vec3 ground_m = legs.sole_m[side] + (far_m > most_m ? most_m / far_m : 1.0F) * off_m;
    float plain_rad[kLegJoints], leg_rad[kLegJoints];
    model::read_leg(leg, goal_rad, plain_rad);
    model::read_leg(leg, goal_rad, leg_rad);
    if (tuning.balance.gravity_enable > 0.5F) {
      const float weight_kg = played.carry[side] * model::total_mass(params);
      balance::add_sag(params, tuning.balance, leg, legs.chain[side],
                       {ground_m, weight_kg * lift, lift, lift}, {}, leg_rad);
    }
    if (tuning.balance.zeros_enable > 0.5F) {
      balance::add_zero(leg, state.zeros.leg[side], leg_rad);
    }
    balance::add(leg, state.feedback.leg[side], leg_rad);
    for (int k = 0; k < kLegJoints; ++k) {
      leg_rad[k] = plain_rad[k] + played.balance * (leg_rad[k] - plain_rad[k]);
    }
    model::write_leg(leg, leg_rad, goal_rad);
  }
}

}  // namespace

void ask_action(const action::Library& actions, const State& state, const Inputs& inputs,
                AdmitOut& admitted) {
  if ((admitted.conditions & safety::kAskStand) == 0 ||
      !action::is_new(actions, state.action, inputs.action)) {
    return;
  }
  admitted.conditions |= safety::kAskAction;
  admitted.conditions &= ~std::uint32_t{safety::kAskWalk};
}

void act(const Params& params, const action::Library& actions, State& state, const Inputs& inputs,
         const AdmitOut& admitted, const balance::AttitudeOut& attitude, Wanted& wanted) {
  if (!plays(state.machine.mode)) {
    // A cut-off action is over; a standing request was played.
    const std::uint8_t asked = inputs.action == state.action.asked ? state.action.asked : 0;
    state.action = action::PlayerState{};
    state.action.asked = asked;
    return;
  }
  action::PlayerOut played = play(params, actions, state, inputs, admitted, attitude, wanted);
  if (state.action.number == 0) return;
  const bool has_legs =
      params.leg[0].solver != LegSolver::kNone && params.leg[1].solver != LegSolver::kNone;
  model::lead(params, played.angle_rad);
  float goal_rad[kMaxJoints];
  for (int j = 0; j < params.joint_count; ++j) goal_rad[j] = played.angle_rad[j];
  if (has_legs && played.balance > 0.0F) {
    const Vec3 com_m = kinematics::center_of_mass(params, Pose{}, goal_rad);
    balance_legs(params, played, attitude, com_m, state, goal_rad);
  }
  model::share_corrections(params, played.angle_rad, goal_rad);
  for (int j = 0; j < params.joint_count; ++j) {
    const float at_rad = model::angle_of(params.joint[j], inputs.position_count[j]);
    // A servo of half the stiffness yields like one whose goal is half as far away.
    const float stiffness = played.stiffness[j];
    wanted.angle_rad[j] =
        stiffness < 1.0F ? at_rad + stiffness * (goal_rad[j] - at_rad) : goal_rad[j];
  }
}

}  // namespace verp::control
