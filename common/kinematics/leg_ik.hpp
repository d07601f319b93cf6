#pragma once
#include <cstdint>

#include "common/kinematics/forward.hpp"
#include "common/math/elementary.hpp"

/// Inverse kinematics of a six-joint leg.
namespace verp::kinematics {

/// What a solution had to give up. 0: the sole stands exactly where it was asked to.
enum LegFlag : std::uint8_t {
  kOutOfReach = 1 << 0,  ///< nearest reachable pose: same orientation, same direction from the hip,
                         ///< leg straight
  kJointLimited = 1 << 1,  ///< at least one joint was held at its limit
  kNotConverged =
      1 << 2,  ///< Newton only: residual above 0.1 mm or 1 mrad after its last iteration
};

struct LegAngles {
  float angle_rad[kLegJoints] = {};  ///< joint angles, hip to ankle, within the joints' limits
  math::SinCos turn[kLegJoints];     ///< of these angles, to 1e-6: what leg_chain wants
  std::uint8_t flags = 0;            ///< LegFlag
};

/// Angles that put the sole at `sole` (body frame). `previous_rad` (six angles) warm-starts Newton
/// and is ignored by the closed form. Total: any pose gives finite angles within the limits.
LegAngles solve_leg(const Params& params, const LegParams& leg, const Pose& sole,
                    const float* previous_rad);

/// The two solvers, by name.
LegAngles solve_leg_closed_form(const Params& params, const LegParams& leg, const Pose& sole);
LegAngles solve_leg_newton(const Params& params, const LegParams& leg, const Pose& sole,
                           const float* previous_rad);

/// Longest distance between hip and ankle centre at which the knee is still bent enough to
/// steer: 99.8 %.
inline float usable_reach_m(const LegParams& leg) {
  return 0.998F * (leg.thigh_m + leg.shank_m);
}

}  // namespace verp::kinematics
