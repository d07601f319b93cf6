#pragma once
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Solver of a six-joint leg, with the reason. Closed form needs the order yaw, roll, pitch, pitch,
/// pitch, roll along the body's axes at the zero pose. Hip axes and ankle axes must each meet in
/// one point, without lateral offset between the two points. Other legs use Newton.
struct LegGeometry {
  bool closed_form = false;
  std::string reason;  ///< reason against closed form; empty: closed form
  double residual_m =
      0;  ///< largest distance of a hip or ankle axis from its common point, or the lateral offset
  Vec3 hip_m = Vec3::Zero();        ///< body frame: where the hip axes (nearly) meet
  Vec3 ankle_m = Vec3::Zero();      ///< the same for the ankle axes
  double thigh_m = 0, shank_m = 0;  ///< in the sagittal plane
  std::array<int, 6> direction{};   ///< joint angle = direction * (canonical - offset)
  std::array<double, 6> offset_rad{};
};

/// Largest residual_m that counts as meeting.
inline constexpr double kAxesMeet = 0.0005;

/// nullptr: no such limb.
const Limb* find_limb(const Entity& entity, const std::string& name);

/// `leg` must have six joints (the loader checks this).
LegGeometry classify_leg(const Entity& entity, const Limb& leg);

/// Position of each node's frame in the body frame at the zero pose.
std::vector<Vec3> node_origins(const Entity& entity);

/// Moves the joint frames of closed-form legs along their axes to where the axes meet, as the
/// solver needs. A file may place a joint anywhere on its axis. The motion of the links does not
/// change.
void gather_leg_frames(Entity& entity);

}  // namespace verp::model
