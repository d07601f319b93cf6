#pragma once
#include "common/action/library.hpp"
#include "common/control/stages.hpp"

namespace verp::control {

/// Sets the condition of a requested action. Drops a walk request meanwhile, so that the walk ends
/// first.
void ask_action(const action::Library& actions, const State& state, const Inputs& inputs,
                AdmitOut& admitted);

/// While the safety table plays an action, `wanted` gets its angles, with balance and gravity on
/// the legs. The ground is assumed level.
void act(const Params& params, const action::Library& actions, State& state, const Inputs& inputs,
         const AdmitOut& admitted, const balance::AttitudeOut& attitude, Wanted& wanted);

}  // namespace verp::control
