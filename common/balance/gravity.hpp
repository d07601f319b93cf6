#pragma once
#include "common/gait/gait.hpp"
#include "common/kinematics/forward.hpp"

/// Gravity feed-forward. A position servo sags under load by torque times compliance, so its goal
/// is set that much beyond the wanted angle. The load is gravity plus the inertia of the planned
/// sway: together a leaning gravity, so the ground pushes from the ZMP towards the centre of mass.
namespace verp::balance {

/// Load of one leg. A link's acceleration is interpolated between body and foot by its height.
struct LegLoad {
  Vec3 ground_m;        ///< where the ground pushes
  Vec3 push_n;          ///< its force
  Vec3 body_lift_m_s2;  ///< acceleration of the body, plus gravity upwards
  Vec3 foot_lift_m_s2;  ///< the same for the foot
};

/// Planned rates and accelerations of a leg's joints, for its rotors' inertia and its gears'
/// friction.
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

/// Takes this tick's planned angles of one leg. A jump, as at the start of a plan, counts as no
/// motion.
LegMotion follow(const Params& params, int side, const float* leg_rad, DriveState& state);

/// Adds the sag of one leg's servos to its joint angles (hip to ankle).
void add_sag(const Params& params, const BalanceTuning& tuning, const LegParams& leg,
             const kinematics::LegChain& chain, const LegLoad& load, const LegMotion& motion,
             float* leg_rad);

/// The point of the planned sole nearest to the ZMP: where the ground pushes.
Vec3 ground_point(const LegParams& leg, const gait::FootPose& foot, gait::Xy zmp_m);

}  // namespace verp::balance
