#pragma once
#include "common/action/library.hpp"
#include "common/control/stages.hpp"

/// Actions within the tick: asked, played, held up.
namespace verp::control {

/// Conditions of an action that is asked. While one waits, no walk is asked: it ends first.
void ask_action(const action::Library& actions, const State& state, const Inputs& inputs,
                AdmitOut& admitted);

/// While the safety table says so, `wanted` becomes what the action wants: its angles, and on the
/// legs what balance and gravity add to them. What the soles stand on is taken for level.
void act(const Params& params, const action::Library& actions, State& state, const Inputs& inputs,
         const AdmitOut& admitted, const balance::AttitudeOut& attitude, Wanted& wanted);

}  // namespace verp::control
