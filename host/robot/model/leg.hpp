#pragma once
#include <array>
#include <optional>
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Joints and solver of a leg. Closed form needs yaw, roll, pitch, pitch, pitch, roll along the
/// body's axes at the zero pose; hip axes and ankle axes each meet in a point, without lateral
/// offset between the points. Other legs use Newton.
struct LegGeometry {
  std::array<int, 6> joint{};  ///< by LegParams' slots; -1: the leg has none there
  bool closed_form = false;
  std::string reason;  ///< reason against closed form; empty: closed form
  double residual_m =
      0;  ///< largest distance of an axis from its common point, or the lateral offset
  Vec3 hip_m = Vec3::Zero();        ///< body frame: meeting point of the hip axes
  Vec3 ankle_m = Vec3::Zero();      ///< the same for the ankle axes
  double thigh_m = 0, shank_m = 0;  ///< in the sagittal plane
  std::array<int, 6> direction{};   ///< joint angle = direction * (canonical - offset)
  std::array<double, 6> offset_rad{};
};

/// Up to this residual_m, axes count as meeting.
inline constexpr double kAxesMeet = 0.0005;

/// nullptr: no such limb.
const Limb* find_limb(const Entity& entity, const std::string& name);

/// nullopt: the leg lacks another joint than hip yaw and ankle roll, or has too many.
std::optional<std::array<int, 6>> slots_of(const Entity& entity, const Limb& leg);

/// `leg` has slots (the loader checks).
LegGeometry classify_leg(const Entity& entity, const Limb& leg);

/// Origins of the nodes' frames, in the body frame at the zero pose.
std::vector<Vec3> node_origins(const Entity& entity);

/// Moves closed-form legs' joint frames along their axes to the meeting points. The links' motion
/// stays.
void gather_leg_frames(Entity& entity);

}  // namespace verp::model
