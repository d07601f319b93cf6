#pragma once
#include "common/gait/gait.hpp"
#include "common/kinematics/forward.hpp"

/// A position servo sags by torque times compliance, so its goal goes that much further. The load
/// is gravity and the inertia of the planned sway: the ground pushes from the ZMP to the centre of
/// mass.
namespace verp::balance {

/// Load of one leg. A link's acceleration is interpolated between body and foot by height.
struct LegLoad {
  Vec3 ground_m;        ///< where the ground pushes
  Vec3 push_n;          ///< its force
  Vec3 body_lift_m_s2;  ///< acceleration of the body, plus gravity upwards
  Vec3 foot_lift_m_s2;  ///< the same for the foot
};

/// Planned motion of a leg, for rotor inertia and gear friction.
struct LegMotion {
  float rate_rad_s[kLegJoints] = {};
  float accel_rad_s2[kLegJoints] = {};
};

/// Both legs' plan in the previous tick.
struct DriveState {
  float angle_rad[kFeet * kLegJoints] = {};
  float rate_rad_s[kFeet * kLegJoints] = {};
  VERP_FIELDS(angle_rad, rate_rad_s)
};
VERP_PACKED(DriveState);

/// Takes one leg's planned angles. A jump, as at a plan's start, is no motion.
LegMotion follow(const Params& params, int side, const float* leg_rad, DriveState& state);

/// Adds the servos' sag to one leg's angles (hip to ankle).
void add_sag(const Params& params, const BalanceTuning& tuning, const LegParams& leg,
             const kinematics::LegChain& chain, const LegLoad& load, const LegMotion& motion,
             float* leg_rad);

/// The planned sole's point nearest to the ZMP.
Vec3 ground_point(const LegParams& leg, const gait::FootPose& foot, gait::Xy zmp_m);

}  // namespace verp::balance
