#pragma once
#include "common/balance/estimator.hpp"
#include "common/gait/gait.hpp"

/// Steps to where a push sends the robot. A push moves the DCM off the plan, a pendulum over the
/// stance foot, further than the sole can hold. The swing foot then lands off its plan by the DCM's
/// error, and the walk goes on. The plan is not recomputed: seen from the new foot the body lags
/// behind it and catches up as a pendulum does.
namespace verp::balance {

struct SteppingState {
  gait::Xy body_m;                    ///< body's offset; the stance foot is on its plan
  gait::Xy foot_m;                    ///< swing foot's offset; both in the walk frame
  std::uint32_t swing = gait::kBoth;  ///< of the goals' step
  std::uint32_t steps = 0;            ///< steps left after a push while standing
  VERP_FIELDS(body_m, foot_m, swing, steps)
};
VERP_PACKED(SteppingState);

struct SteppingIn {
  const gait::GaitState* gait = nullptr;
  const EstimatorState* estimator = nullptr;
  float heading_rad = 0;  ///< body's, in the estimator's axes
  float period_s = 0.01F;
};

/// Moves the plan's feet, and the ZMP under them, by the offsets.
void step_aside(const Params& params, const Tuning& tuning, const SteppingIn& in,
                SteppingState& state, gait::GaitOut& plan);

/// True if a push moves a standing robot's DCM out of its soles: it must step now. False if it is
/// not known to stand on its soles.
bool pushed(const Params& params, const Tuning& tuning, const SteppingIn& in, SteppingState& state);

/// True if body and swing foot are within `most_m` of the plan.
bool as_planned(const SteppingState& state, float most_m);

}  // namespace verp::balance
