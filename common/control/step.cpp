#include "common/control/step.hpp"

#include "common/control/acting.hpp"
#include "common/control/digest_state.hpp"
#include "common/control/falling.hpp"
#include "common/control/stages.hpp"

namespace verp {

void step(const Params& params, const action::Library& actions, State& state, const Inputs& inputs,
          Outputs& outputs) noexcept {
  using namespace control;
  if (state.admit.started == 0) start(params, inputs, state);

  const safety::Doubts doubts = doubt(params, state, inputs);
  AdmitOut admitted = admit(params, state.admit, state.tuning, inputs, doubts);
  ask_action(actions, state, inputs, admitted);
  const balance::AttitudeOut attitude = estimate(params, state, admitted);
  locate(params, state, inputs, admitted);
  watch_fall(params, actions, state, inputs, attitude, admitted);
  watch_push(params, state, admitted);
  gait::GaitOut plan = plan_motion(params, state, admitted, attitude);
  step_aside(params, state, plan);
  lean(params, state, admitted, attitude, plan);
  state.feedback = balance::feedback(state.tuning.balance, attitude,
                                     state.tuning.gait.trunk_pitch_rad, plan.swing);
  Wanted wanted = solve_joints(params, state, inputs, admitted, attitude, plan);
  watch_load(params, state, inputs, wanted, admitted);
  act(params, actions, state, inputs, admitted, attitude, wanted);
  const safety::LimitOut limited = limit_goals(params, state, inputs, wanted);
  const std::uint32_t faults = raise_faults(state, admitted, wanted, limited);
  gate(params, state, admitted, attitude, plan, limited, faults, outputs);

  digest_state(inputs, outputs, state);
}

}  // namespace verp
