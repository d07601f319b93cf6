#pragma once
#include <cstdint>

#include "common/kinematics/forward.hpp"
#include "common/math/elementary.hpp"

namespace verp::kinematics {

/// Compromises of a solution. 0: the sole is exactly in place.
enum LegFlag : std::uint8_t {
  kOutOfReach = 1 << 0,    ///< nearest reachable: same orientation and hip direction, straight leg
  kJointLimited = 1 << 1,  ///< at least one joint at its limit
  kNotConverged = 1 << 2,  ///< Newton: residual above 0.1 mm or 1 mrad
};

struct LegAngles {
  float angle_rad[kLegJoints] = {};  ///< hip to ankle, in the limits
  math::SinCos turn[kLegJoints];     ///< sines of these angles, to 1e-6, for leg_chain
  std::uint8_t flags = 0;            ///< LegFlag
};

/// `sole`: body frame. `previous_rad` (six angles) starts Newton; the closed form ignores it.
/// Total: any pose gives finite angles within the limits.
LegAngles solve_leg(const Params& params, const LegParams& leg, const Pose& sole,
                    const float* previous_rad);

LegAngles solve_leg_closed_form(const Params& params, const LegParams& leg, const Pose& sole);
LegAngles solve_leg_newton(const Params& params, const LegParams& leg, const Pose& sole,
                           const float* previous_rad);

/// Longest hip-ankle distance that leaves the knee bent enough to steer: 99.8 %.
inline float usable_reach_m(const LegParams& leg) {
  return 0.998F * (leg.thigh_m + leg.shank_m);
}

}  // namespace verp::kinematics
