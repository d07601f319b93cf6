#pragma once
#include "common/balance/estimator.hpp"
#include "common/gait/gait.hpp"

/// Steps where a push sends the robot. The plan is a pendulum over the stance foot. A push moves
/// the DCM off the plan by more than the sole can hold. So the swing foot lands off its plan by the
/// same amount: over that foot the DCM is where it was planned, and the walk goes on. The plan
/// itself does not change. Seen from the new foot the body is behind its plan; it catches up as a
/// pendulum does, which leaves the DCM unchanged.
namespace verp::balance {

struct SteppingState {
  gait::Xy body_m;  ///< body's offset from its plan; the stance foot is on its plan
  gait::Xy foot_m;  ///< the swing foot's; both in the plan's walk frame
  std::uint32_t swing = gait::kBoth;  ///< of the step that the goals are in
  std::uint32_t steps = 0;  ///< steps that a robot pushed while standing still has to take
  VERP_FIELDS(body_m, foot_m, swing, steps)
};
VERP_PACKED(SteppingState);

struct SteppingIn {
  const gait::GaitState* gait = nullptr;
  const EstimatorState* estimator = nullptr;
  float heading_rad = 0;  ///< heading of the body in the estimator's axes
  float period_s = 0.01F;
};

/// Moves the plan's feet, and the ZMP under them, to where they have to be.
void step_aside(const Params& params, const Tuning& tuning, const SteppingIn& in,
                SteppingState& state, gait::GaitOut& plan);

/// True if a push on a standing robot is about to move its DCM out of the soles: it has to step now
/// and a few times more. False if the estimator does not know that the robot stands on its soles.
bool pushed(const Params& params, const Tuning& tuning, const SteppingIn& in, SteppingState& state);

/// True if body and swing foot are within `most_m` of their plan.
bool as_planned(const SteppingState& state, float most_m);

}  // namespace verp::balance
