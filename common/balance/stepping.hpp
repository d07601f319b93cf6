#pragma once
#include "common/balance/estimator.hpp"
#include "common/gait/gait.hpp"

/// Stepping where a push sends the robot. The plan is a pendulum over the foot that carries; a push
/// throws the DCM off it, and all that a foot can do is to hold what its sole reaches. So the swing
/// foot lands off its plan by as much as the DCM is: over that foot the DCM is where it was planned
/// to be, and the walk goes on from there. The plan stays as it is and is not worked anew: seen
/// from the new foot the body is behind it by the same way, and makes up for that as a pendulum
/// would, without moving the DCM.
namespace verp::balance {

struct SteppingState {
  gait::Xy body_m;  ///< by how much the body is off its plan, as the foot that carries is on it
  gait::Xy foot_m;  ///< likewise the swing foot; walk frame's axes, as all of the plan
  std::uint32_t swing = gait::kBoth;  ///< of the step that the goals are in
  std::uint32_t steps = 0;            ///< that a robot pushed as it stood has still to take
  VERP_FIELDS(body_m, foot_m, swing, steps)
};
VERP_PACKED(SteppingState);

struct SteppingIn {
  const gait::GaitState* gait = nullptr;
  const EstimatorState* estimator = nullptr;
  float heading_rad = 0;  ///< that the estimator's axes are turned from the body's by
  float period_s = 0.01F;
};

/// Moves feet (and with them the ZMP under them) of the plan to where they have to be.
void step_aside(const Params& params, const Tuning& tuning, const SteppingIn& in,
                SteppingState& state, gait::GaitOut& plan);

/// A robot that stands was pushed so that its DCM is about to leave the soles: it has to step, now
/// and a few times more. Not where it does not know itself to stand on its soles.
bool pushed(const Params& params, const Tuning& tuning, const SteppingIn& in, SteppingState& state);

/// Nothing is further off its plan than this.
bool as_planned(const SteppingState& state, float most_m);

}  // namespace verp::balance
