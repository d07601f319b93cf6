#pragma once
#include <cstdint>

#include "common/kinematics/forward.hpp"
#include "common/math/elementary.hpp"

/// Inverse kinematics of a six-joint leg.
namespace verp::kinematics {

/// Compromises of a solution. 0: the sole is exactly at its target.
enum LegFlag : std::uint8_t {
  kOutOfReach =
      1
      << 0,  ///< nearest reachable pose: same orientation and direction from the hip, leg straight
  kJointLimited = 1 << 1,  ///< at least one joint is at its limit
  kNotConverged =
      1 << 2,  ///< Newton only: residual above 0.1 mm or 1 mrad after the last iteration
};

struct LegAngles {
  float angle_rad[kLegJoints] = {};  ///< hip to ankle, within the joints' limits
  math::SinCos turn[kLegJoints];     ///< sines and cosines of these angles, to 1e-6, for leg_chain
  std::uint8_t flags = 0;            ///< LegFlag
};

/// Angles that put the sole at `sole` (body frame). `previous_rad` (six angles) warm-starts Newton
/// and is ignored by the closed form. Total: any pose gives finite angles within the limits.
LegAngles solve_leg(const Params& params, const LegParams& leg, const Pose& sole,
                    const float* previous_rad);

LegAngles solve_leg_closed_form(const Params& params, const LegParams& leg, const Pose& sole);
LegAngles solve_leg_newton(const Params& params, const LegParams& leg, const Pose& sole,
                           const float* previous_rad);

/// Longest hip-ankle distance at which the knee is bent enough to steer: 99.8 % of a straight leg.
inline float usable_reach_m(const LegParams& leg) {
  return 0.998F * (leg.thigh_m + leg.shank_m);
}

}  // namespace verp::kinematics
