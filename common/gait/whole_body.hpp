#pragma once
#include "common/gait/swing.hpp"
#include "common/kinematics/leg_ik.hpp"

/// The planner's mass model: twelve leg links and one lump for everything the legs carry.
namespace verp::gait {

inline constexpr int kPoints = 1 + kFeet * kLegJoints;

/// Trunk, arms and head as one mass fixed in the body frame.
struct Lump {
  float mass_kg = 0;
  Xyz com_body_m;
  VERP_FIELDS(mass_kg, com_body_m)
};
VERP_PACKED(Lump);

/// All links except the legs', at the given joint angles.
Lump lump_of(const Params& params, const float* angle_rad);

/// Digest of the angles that lump_of reads: it changes when the lump may.
std::uint32_t digest_load(const Params& params, const float* angle_rad);

/// Body and feet at one moment, walk frame.
struct Posture {
  Pose body;
  FootPose foot[kFeet];
};

/// Body above (x, y) for given feet: height and trunk pitch from the tuning, heading midway between
/// the feet's.
Posture posture_of(const Params& params, const GaitTuning& tuning, Xy body_m, const FootPose& left,
                   const FootPose& right);

/// Sole frame of one foot, seen from the body.
Pose sole_in_body(const Posture& posture, int side);

/// Mass points of the lump (index 0) and of the left and right leg's links, and their common
/// centre.
struct Masses {
  Vec3 point_m[kPoints];
  Vec3 com_m;
  float mass_kg = 0;
  std::uint8_t leg_flags = 0;  ///< LegFlag of both legs; not 0 if a sole misses its target
};

/// Newton's starting angles: the stand pose, because at zero a knee may bend the wrong way.
void stand_legs(const Params& params, float* leg_rad);

/// Solves both legs for `posture` and weighs them with the lump. `leg_rad` holds the twelve
/// previous leg angles (Newton's warm start) and receives the new ones; a leg that did not converge
/// gets its stand pose.
Masses weigh(const Params& params, const Lump& lump, const Posture& posture, float* leg_rad);
float point_mass_kg(const Params& params, const Lump& lump, int point);

/// Displacement of the centre of mass per displacement of the body with fixed feet (0.5 to 1): leg
/// links follow in proportion to their height above the ankle. A CoM correction is divided by it.
float com_share(const Params& params, const Lump& lump, const Posture& posture,
                const Masses& masses);

}  // namespace verp::gait
