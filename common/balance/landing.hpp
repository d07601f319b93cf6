#pragma once
#include "common/gait/gait.hpp"

/// Where the feet really land. A leg that swings is a pendulum on its servos' springs, and a servo
/// at its torque limit brakes late: the foot swings beyond where it was aimed (a tenth of its way
/// at 8 cm in 400 ms), and the robot walks faster than its plan. When a foot lands, the encoders
/// say how far the soles are apart; the share of the way that was too much is learnt, and the next
/// feet are aimed that much shorter. The plan stays as it is: aimed shorter, they land where it
/// says.
namespace verp::balance {

struct LandingState {
  float beyond = 0;  ///< share of its way that a foot, aimed as planned, would swing too far
  std::uint32_t carrying = gait::kBoth;  ///< GaitOut::carrying of the tick before
  VERP_FIELDS(beyond, carrying)
};
VERP_PACKED(LandingState);

/// A foot that was sent further off its plan has landed there, and says nothing of servos. Less
/// than this is in every second of a hurried walk: who learnt from none of those walked 0.45 m/s
/// for 0.40.
inline constexpr float kOffPlan_m = 0.002F;

/// In the tick in which another foot begins to carry, learns from where it landed; not if a joint
/// of the legs has not reported in this tick, or the foot was sent elsewhere (stepping.hpp).
void learn_landing(const Params& params, const gait::GaitState& gait, const gait::GaitOut& plan,
                   const Inputs& inputs, bool as_planned, LandingState& state);

/// Where to aim foot `side`: a swinging one short of its plan. One that has landed there returns to
/// its plan while its servos come to rest.
gait::FootPose aim(const gait::GaitState& gait, const LandingState& state, int side,
                   const gait::FootPose& planned);

}  // namespace verp::balance
