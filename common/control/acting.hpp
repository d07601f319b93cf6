#pragma once
#include "common/action/library.hpp"
#include "common/control/stages.hpp"

/// Actions in the tick: requested, played, balanced.
namespace verp::control {

/// Adds the condition of a requested action and drops a walk request while it waits: the walk ends
/// first.
void ask_action(const action::Library& actions, const State& state, const Inputs& inputs,
                AdmitOut& admitted);

/// If the safety table lets an action play, replaces `wanted` by the action's angles, with balance
/// and gravity corrections on the legs. The ground is assumed level.
void act(const Params& params, const action::Library& actions, State& state, const Inputs& inputs,
         const AdmitOut& admitted, const balance::AttitudeOut& attitude, Wanted& wanted);

}  // namespace verp::control
