#pragma once
#include "common/control/state.hpp"
#include "common/model/params.hpp"

/// The stages of step(), each one thought. They join the modules; the arithmetic is in the modules.
namespace verp::control {

/// First tick: tuning from Params, ages from its inputs.
void start(const Params& params, const Inputs& inputs, State& state);

balance::AttitudeOut estimate(const Params& params, State& state, const AdmitOut& admitted);

/// Where body and centre of mass are, by what the legs tell. The plan is that of the tick before.
void locate(const Params& params, State& state, const Inputs& inputs, const AdmitOut& admitted);

/// Condition of a push that ankles don't answer.
void watch_push(const Params& params, State& state, AdmitOut& admitted);

/// Walks when the safety table says so, and turns back what the heading has drifted.
gait::GaitOut plan_motion(const Params& params, State& state, const AdmitOut& admitted,
                          const balance::AttitudeOut& attitude);

/// Moves the plan's feet to where a push has sent the robot.
void step_aside(const Params& params, State& state, gait::GaitOut& plan);

/// Keeps the body upright on ground that slopes.
void lean(const Params& params, State& state, const AdmitOut& admitted,
          const balance::AttitudeOut& attitude, gait::GaitOut& plan);

struct Wanted {
  float angle_rad[kMaxJoints];
  float plain_rad[kMaxJoints];  ///< without sag, zeros and feedback
  bool leg_limited;
};

/// Legs by inverse kinematics, with gravity sag, balance corrections and learnt zero errors and
/// landings; arms rest; the head looks where told.
Wanted solve_joints(const Params& params, State& state, const Inputs& inputs,
                    const AdmitOut& admitted, const balance::AttitudeOut& attitude,
                    const gait::GaitOut& plan);

safety::LimitOut limit_goals(const Params& params, State& state, const Inputs& inputs,
                             const Wanted& wanted);

/// Fault bits of this tick.
std::uint32_t raise_faults(const State& state, const AdmitOut& admitted, const Wanted& wanted,
                           const safety::LimitOut& limited);

/// The safety table has the last word: mode, torque and goals.
void gate(const Params& params, State& state, const AdmitOut& admitted,
          const balance::AttitudeOut& attitude, const gait::GaitOut& plan,
          const safety::LimitOut& limited, std::uint32_t faults, Outputs& outputs);

}  // namespace verp::control
