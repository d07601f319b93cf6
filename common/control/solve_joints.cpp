#include "common/balance/arms.hpp"
#include "common/balance/gravity.hpp"
#include "common/balance/landing.hpp"
#include "common/control/stages.hpp"
#include "common/gait/coupled_hips.hpp"
#include "common/math/convert.hpp"
#include "common/model/coupling.hpp"
#include "common/model/leg.hpp"
#include "common/model/tree.hpp"

namespace verp::control {
namespace {

// One leg's angles, each joint with its own delay, if any.
kinematics::LegAngles leg_angles(const Params& params, const State& state,
                                 const gait::Posture& posture, int side, const float* previous) {
  const LegParams& leg = params.leg[side];
  kinematics::LegAngles angles =
      kinematics::solve_leg(params, leg, gait::sole_in_body(posture, side), previous);
  const float delay_s = state.tuning.gait.joint_delay_s;
  for (int k = 1; delay_s > 0.0F && k < kLegJoints; ++k) {
    const auto delay_us = math::to_int32(delay_s * static_cast<float>(k) * 1e6F);
    const gait::Posture earlier = gait::posture_before(params, state.tuning, state.gait, delay_us);
    const kinematics::LegAngles late =
        kinematics::solve_leg(params, leg, gait::sole_in_body(earlier, side), previous);
    angles.angle_rad[k] = late.angle_rad[k];
    angles.turn[k] = late.turn[k];
  }
  return angles;
}

// Third to sixth state after an exchange: landed, and the next not begun.
bool in_mid_step(const gait::GaitOut& plan) {
  const int state = plan.cycle_state & 7;
  return state >= 3 && state <= 6;
}

// True if one foot is in the air, the other's pressure is well inside its sole, and the angles are
// exact and undelayed. Without sensors, mid-step.
bool carries_flat(const Params& params, const State& state, const gait::GaitOut& plan,
                  const Inputs& inputs, int side, const kinematics::LegAngles& angles) {
  if (plan.swing == gait::kBoth || plan.swing == side || angles.flags != 0 ||
      state.tuning.gait.joint_delay_s != 0.0F)
    return false;
  if (params.feet.device_id[side] == 0) return in_mid_step(plan);
  return (inputs.flags & kFeetFresh) != 0 && balance::stands_flat(inputs.foot_count[side]);
}

// Delayed joints are planned at other moments.
bool aims(const Tuning& tuning) {
  return tuning.balance.zeros_enable > 0.5F && tuning.gait.joint_delay_s == 0.0F;
}

balance::LegLoad load_of(const Params& params, const gait::GaitOut& plan, int side, float mass_kg) {
  const gait::FootPose& foot = plan.posture.foot[side];
  const Vec3 gravity{0, 0, math::kGravityMS2};
  const Vec3 body_lift = gravity + Vec3(plan.accel_m_s2.x, plan.accel_m_s2.y, 0);
  return {balance::ground_point(params.leg[side], foot, plan.zmp_m),
          plan.carry[side] * mass_kg * body_lift, body_lift,
          gravity + math::to_vec(foot.accel_m_s2)};
}

// Start of each leg's search. A robot that does not walk may be in any pose: take the angles of its
// last weighing.
struct Before {
  float leg_rad[kFeet][kLegJoints];
};

Before angles_before(const Params& params, const State& state) {
  Before before;
  for (int side = 0; side < kFeet; ++side) {
    if (state.gait.queued != 0) {
      model::read_leg(params.leg[side], state.limit.goal_rad, before.leg_rad[side]);
      continue;
    }
    for (int k = 0; k < kLegJoints; ++k) {
      before.leg_rad[side][k] = state.gait.preview.leg_rad[side * kLegJoints + k];
    }
  }
  return before;
}

void rest_joints(const Params& params, const State& state, const AdmitOut& admitted,
                 const gait::GaitOut& plan, Wanted& wanted) {
  for (int j = 0; j < params.joint_count; ++j) wanted.angle_rad[j] = params.joint[j].stand_rad;
  if (params.head_pan < kMaxJoints) wanted.angle_rad[params.head_pan] = admitted.head_pan_rad;
  if (params.head_tilt < kMaxJoints) wanted.angle_rad[params.head_tilt] = admitted.head_tilt_rad;
  balance::swing_arms(params, state.tuning.balance, plan.posture, wanted.angle_rad);
  for (int j = 0; j < params.joint_count; ++j) wanted.plain_rad[j] = wanted.angle_rad[j];
}

gait::Posture aim_feet(const Params& params, State& state, const Inputs& inputs,
                       const gait::GaitOut& plan) {
  gait::Posture aimed = plan.posture;
  balance::learn_landing(params, state.gait, plan, inputs,
                         balance::as_planned(state.stepping, balance::kOffPlan_m), state.landing);
  if (aims(state.tuning)) {
    for (int side = 0; side < kFeet; ++side) {
      aimed.foot[side] = balance::aim(state.gait, state.landing, side, aimed.foot[side]);
    }
  } else {
    state.landing.beyond = 0;
  }
  return aimed;
}

void correct_leg(const Params& params, State& state, const Inputs& inputs,
                 const balance::AttitudeOut& attitude, const gait::GaitOut& plan, float mass_kg,
                 int side, kinematics::LegAngles& angles) {
  const Tuning& tuning = state.tuning;
  const LegParams& leg = params.leg[side];
  const kinematics::LegChain chain =
      kinematics::leg_chain(params, leg, plan.posture.body, angles.turn);
  balance::LegZero& zero = state.zeros.leg[side];
  if (carries_flat(params, state, plan, inputs, side, angles)) {
    balance::learn_zero(params, leg, chain, angles.angle_rad, plan.posture.foot[side], inputs,
                        attitude, tuning.gait.trunk_pitch_rad, zero);
  }
  const balance::LegMotion motion = balance::follow(params, side, angles.angle_rad, state.drive);
  if (tuning.balance.gravity_enable > 0.5F) {
    balance::add_sag(params, tuning.balance, leg, chain, load_of(params, plan, side, mass_kg),
                     motion, angles.angle_rad);
  }
  if (tuning.balance.zeros_enable > 0.5F) balance::add_zero(leg, zero, angles.angle_rad);
  balance::add(leg, state.feedback.leg[side], angles.angle_rad);
}

}  // namespace

Wanted solve_joints(const Params& params, State& state, const Inputs& inputs,
                    const AdmitOut& admitted, const balance::AttitudeOut& attitude,
                    const gait::GaitOut& plan) {
  Wanted wanted{};
  rest_joints(params, state, admitted, plan, wanted);
  gait::Posture aimed = aim_feet(params, state, inputs, plan);
  const Before before = angles_before(params, state);
  const float mass_kg = model::total_mass(params);
  gait::turn_to_hips(params, before.leg_rad, aimed);
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params.leg[side];
    if (leg.solver == LegSolver::kNone) continue;
    kinematics::LegAngles angles = leg_angles(params, state, aimed, side, before.leg_rad[side]);
    wanted.leg_limited = wanted.leg_limited || angles.flags != 0;
    model::write_leg(leg, angles.angle_rad, wanted.plain_rad);
    correct_leg(params, state, inputs, attitude, plan, mass_kg, side, angles);
    model::write_leg(leg, angles.angle_rad, wanted.angle_rad);
  }
  model::share_corrections(params, wanted.plain_rad, wanted.angle_rad);
  return wanted;
}

}  // namespace verp::control
