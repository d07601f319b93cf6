#pragma once
#include "common/gait/gait.hpp"
#include "common/kinematics/forward.hpp"

/// Gravity feed-forward: a position servo sags under load by torque times compliance, so its goal
/// is set that much beyond the angle wanted. The load is gravity and the inertia of the planned
/// sway, which together act like a gravity that leans: the ground's push points from the ZMP to the
/// centre of mass, not straight up.
namespace verp::balance {

/// What one leg bears. Its links share the acceleration of body and foot by their height between
/// the two.
struct LegLoad {
  Vec3 ground_m;        ///< where the ground pushes
  Vec3 push_n;          ///< with what force
  Vec3 body_lift_m_s2;  ///< acceleration of the body, plus gravity upwards
  Vec3 foot_lift_m_s2;  ///< of the foot, likewise
};

/// How the leg's joints turn in the plan: what its rotors' inertia and its gears' friction take.
struct LegMotion {
  float rate_rad_s[kLegJoints] = {};
  float accel_rad_s2[kLegJoints] = {};
};

/// Both legs' plan of the tick before.
struct DriveState {
  float angle_rad[kFeet * kLegJoints] = {};
  float rate_rad_s[kFeet * kLegJoints] = {};
  VERP_FIELDS(angle_rad, rate_rad_s)
};
VERP_PACKED(DriveState);

/// Takes this tick's planned angles of one leg. A leap, as where a plan begins, is no motion.
LegMotion follow(const Params& params, int side, const float* leg_rad, DriveState& state);

/// Adds the sag of one leg's servos to its joint angles (hip to ankle).
void add_sag(const Params& params, const BalanceTuning& tuning, const LegParams& leg,
             const kinematics::LegChain& chain, const LegLoad& load, const LegMotion& motion,
             float* leg_rad);

/// The point of the sole, as planned, nearest to the ZMP: where the ground pushes.
Vec3 ground_point(const LegParams& leg, const gait::FootPose& foot, gait::Xy zmp_m);

}  // namespace verp::balance
