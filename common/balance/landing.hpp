#pragma once
#include "common/gait/gait.hpp"

/// Learns where the feet land. The swing leg is a pendulum on its servos' springs, and a servo at
/// its torque limit brakes late. The foot overshoots (a tenth of its way at 8 cm in 400 ms), and
/// the robot walks faster than planned. At each landing the encoders give the distance between the
/// soles; the excess as a share of the way is learnt. The next feet are aimed that much shorter and
/// land on the unchanged plan.
namespace verp::balance {

struct LandingState {
  float beyond = 0;  ///< overshoot of a foot aimed as planned, as a share of its way
  std::uint32_t carrying = gait::kBoth;  ///< GaitOut::carrying of the previous tick
  VERP_FIELDS(beyond, carrying)
};
VERP_PACKED(LandingState);

/// A foot moved further off its plan than this says nothing about the servos. Smaller moves occur
/// in every second of a hurried walk: a robot that skipped those too walked 0.45 m/s instead of
/// 0.40.
inline constexpr float kOffPlan_m = 0.002F;

/// Learns in the tick in which another foot begins to carry. Skips the landing if a leg joint did
/// not report this tick or the foot was moved off its plan (stepping.hpp).
void learn_landing(const Params& params, const gait::GaitState& gait, const gait::GaitOut& plan,
                   const Inputs& inputs, bool as_planned, LandingState& state);

/// Target of foot `side`. A swing foot is aimed short of its plan; a landed one returns to its plan
/// while its servos come to rest.
gait::FootPose aim(const gait::GaitState& gait, const LandingState& state, int side,
                   const gait::FootPose& planned);

}  // namespace verp::balance
