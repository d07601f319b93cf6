#pragma once
#include "common/gait/gait.hpp"

/// Learns where feet land. The swing leg swings on its servos' springs, and a servo at its torque
/// limit brakes late, so the foot overshoots (a tenth of its way at 8 cm in 400 ms). At a landing
/// the encoders give the soles' distance. The excess share is learnt, and the next feet are aimed
/// shorter.
namespace verp::balance {

struct LandingState {
  float beyond = 0;                      ///< overshoot, as a share of the way
  std::uint32_t carrying = gait::kBoth;  ///< GaitOut::carrying, previous tick
  VERP_FIELDS(beyond, carrying)
};
VERP_PACKED(LandingState);

/// A foot that was moved further off its plan teaches nothing about its servos. Smaller moves must
/// count: without them the robot walked at 0.45 m/s instead of 0.40.
inline constexpr float kOffPlan_m = 0.002F;

/// Learns when another foot begins to carry; not if a leg joint did not report or the foot was
/// moved off its plan (stepping.hpp).
void learn_landing(const Params& params, const gait::GaitState& gait, const gait::GaitOut& plan,
                   const Inputs& inputs, bool as_planned, LandingState& state);

/// Aims a swing foot short of its plan. A landed foot returns to its plan while its servos come to
/// rest.
gait::FootPose aim(const gait::GaitState& gait, const LandingState& state, int side,
                   const gait::FootPose& planned);

}  // namespace verp::balance
