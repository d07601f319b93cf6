#pragma once
#include "common/gait/swing.hpp"
#include "common/kinematics/leg_ik.hpp"

namespace verp::gait {

inline constexpr int kPoints = 1 + kFeet * kLegJoints;

/// Trunk, arms and head as one mass in the body frame.
struct Lump {
  float mass_kg = 0;
  Xyz com_body_m;
  VERP_FIELDS(mass_kg, com_body_m)
};
VERP_PACKED(Lump);

/// All but the legs' links.
Lump lump_of(const Params& params, const float* angle_rad);

/// Covers the angles that lump_of reads, but not a leg's: toes count where they were at the last
/// weighing.
std::uint32_t digest_load(const Params& params, const float* angle_rad);

/// Body and feet, walk frame.
struct Posture {
  Pose body;
  FootPose foot[kFeet];
};

/// Body above (x, y): height and pitch from the tuning, heading midway between the feet's.
Posture posture_of(const Params& params, const GaitTuning& tuning, Xy body_m, const FootPose& left,
                   const FootPose& right);

Pose sole_in_body(const Posture& posture, int side);

/// Mass points of lump (index 0) and leg links, left then right; their centre.
struct Masses {
  Vec3 point_m[kPoints];
  Vec3 com_m;
  float mass_kg = 0;
  std::uint8_t leg_flags = 0;  ///< both legs; 0: both soles reach their targets
};

/// Newton's start is the stand: at zero a knee may bend the wrong way.
void stand_legs(const Params& params, float* leg_rad);

/// Solves both legs and weighs them with the lump. `leg_rad`: the last twelve leg angles (Newton's
/// start); gets the new ones, or the stand if a leg did not converge.
Masses weigh(const Params& params, const Lump& lump, const Posture& posture, float* leg_rad);
float point_mass_kg(const Params& params, const Lump& lump, int point);

/// CoM displacement per body displacement with fixed feet (0.5 to 1): leg links move in proportion
/// to their height. Divide a CoM correction by it.
float com_share(const Params& params, const Lump& lump, const Posture& posture,
                const Masses& masses);

}  // namespace verp::gait
