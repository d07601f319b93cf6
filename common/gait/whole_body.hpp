#pragma once
#include "common/gait/swing.hpp"
#include "common/kinematics/leg_ik.hpp"

/// The robot as the planner weighs it: twelve leg links and one lump for everything the legs carry.
namespace verp::gait {

inline constexpr int kPoints = 1 + kFeet * kLegJoints;

/// Trunk, arms and head as one mass fixed in the body frame.
struct Lump {
  float mass_kg = 0;
  Xyz com_body_m;
  VERP_FIELDS(mass_kg, com_body_m)
};
VERP_PACKED(Lump);

/// All links but the legs', at the joint angles given.
Lump lump_of(const Params& params, const float* angle_rad);

/// Of the angles that lump_of reads: equal as long as the lump is.
std::uint32_t digest_load(const Params& params, const float* angle_rad);

/// Where body and feet are at one moment, walk frame.
struct Posture {
  Pose body;
  FootPose foot[kFeet];
};

/// Body above (x, y) with the feet as given: height and trunk pitch from the tuning, heading
/// between the feet.
Posture posture_of(const Params& params, const GaitTuning& tuning, Xy body_m, const FootPose& left,
                   const FootPose& right);

/// The sole frame of one foot, seen from the body.
Pose sole_in_body(const Posture& posture, int side);

/// Mass points of the lump (index 0) and of the left and right leg's links, and their common
/// centre.
struct Masses {
  Vec3 point_m[kPoints];
  Vec3 com_m;
  float mass_kg = 0;
  std::uint8_t leg_flags = 0;  ///< LegFlag of both legs: not 0, they don't get where they should
};

/// Where Newton's legs start from: their stand pose, as their zero may be bent the wrong way.
void stand_legs(const Params& params, float* leg_rad);

/// Solves both legs for `posture` and weighs them and the lump. `leg_rad` holds the twelve leg
/// angles of the time before (Newton's warm start) and takes the new ones; those of a leg that did
/// not get there are its stand pose again.
Masses weigh(const Params& params, const Lump& lump, const Posture& posture, float* leg_rad);
float point_mass_kg(const Params& params, const Lump& lump, int point);

/// How far the centre of mass moves when the body moves by one, with the feet fixed (0.5 to 1): leg
/// links follow in proportion to their height above the ankle. Inverse of what a CoM correction
/// must be multiplied by.
float com_share(const Params& params, const Lump& lump, const Posture& posture,
                const Masses& masses);

}  // namespace verp::gait
