#pragma once
#include "common/control/state.hpp"
#include "common/model/params.hpp"

namespace verp::control {

/// First tick: copies the tuning from Params and starts the ages.
void start(const Params& params, const Inputs& inputs, State& state);

/// Which devices not to believe in this tick.
safety::Doubts doubt(const Params& params, State& state, const Inputs& inputs);

balance::AttitudeOut estimate(const Params& params, State& state, const AdmitOut& admitted);

/// Locates body and centre of mass from the legs, by the last tick's plan.
void locate(const Params& params, State& state, const Inputs& inputs, const AdmitOut& admitted);

/// Sets the condition of a push beyond what ankles balance.
void watch_push(const Params& params, State& state, AdmitOut& admitted);

/// Walks if the safety table says so, and corrects heading drift.
gait::GaitOut plan_motion(const Params& params, State& state, const AdmitOut& admitted,
                          const balance::AttitudeOut& attitude);

void step_aside(const Params& params, State& state, gait::GaitOut& plan);

void lean(const Params& params, State& state, const AdmitOut& admitted,
          const balance::AttitudeOut& attitude, gait::GaitOut& plan);

struct Wanted {
  float angle_rad[kMaxJoints];
  float plain_rad[kMaxJoints];  ///< without sag, zeros and feedback
  bool leg_limited;
};

/// Legs with sag, balance, learnt zeros and landings; arms and head.
Wanted solve_joints(const Params& params, State& state, const Inputs& inputs,
                    const AdmitOut& admitted, const balance::AttitudeOut& attitude,
                    const gait::GaitOut& plan);

/// Raises the fault of feet that carry nothing.
void watch_load(const Params& params, State& state, const Inputs& inputs, const Wanted& wanted,
                AdmitOut& admitted);

safety::LimitOut limit_goals(const Params& params, State& state, const Inputs& inputs,
                             const Wanted& wanted);

std::uint32_t raise_faults(const State& state, const AdmitOut& admitted, const Wanted& wanted,
                           const safety::LimitOut& limited);

/// The safety table decides mode, torque and goals.
void gate(const Params& params, State& state, const AdmitOut& admitted,
          const balance::AttitudeOut& attitude, const gait::GaitOut& plan,
          const safety::LimitOut& limited, std::uint32_t faults, Outputs& outputs);

}  // namespace verp::control
