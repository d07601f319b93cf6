#pragma once
#include "common/gait/gait.hpp"
#include "common/kinematics/forward.hpp"

/// Gravity feed-forward: a position servo sags under load by torque times compliance, so its goal
/// is set that much beyond the angle wanted.
namespace verp::balance {

/// Adds the sag of one leg's servos to its joint angles (hip to ankle). The ground pushes up on the
/// sole, at the planned ZMP, with `carried_n`; the leg's own links pull down. The ZMP is limited to
/// the sole's outline, so that a share of weight near zero has no lever.
void add_sag(const Params& params, const LegParams& leg, const kinematics::LegChain& chain,
             const Vec3& ground_m, float carried_n, float* leg_rad);

/// The point of the sole, as planned, nearest to the ZMP: where the ground pushes.
Vec3 ground_point(const LegParams& leg, const gait::FootPose& foot, gait::Xy zmp_m);

}  // namespace verp::balance
