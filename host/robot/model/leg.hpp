#pragma once
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// How a six-joint leg is solved, and why. Closed form needs the order yaw, roll, pitch, pitch,
/// pitch, roll along the body's axes at the zero pose, hip axes that meet in one point, ankle axes
/// that meet in one point, and no lateral offset between the two; else Newton.
struct LegGeometry {
  bool closed_form = false;
  std::string reason;  ///< why not closed form; empty if it is
  double residual_m =
      0;  ///< largest distance of a hip or ankle axis from the common point, or lateral offset
  Vec3 hip_m = Vec3::Zero();        ///< in the body frame: where the hip axes (nearly) meet
  Vec3 ankle_m = Vec3::Zero();      ///< likewise the ankle axes
  double thigh_m = 0, shank_m = 0;  ///< in the sagittal plane
  std::array<int, 6> direction{};   ///< joint angle = direction * (canonical - offset)
  std::array<double, 6> offset_rad{};
};

/// Largest residual_m that still counts as meeting.
inline constexpr double kAxesMeet = 0.0005;

/// nullptr when the robot has no such limb.
const Limb* find_limb(const Entity& entity, const std::string& name);

/// `leg` must have six joints (the loader sees to it).
LegGeometry classify_leg(const Entity& entity, const Limb& leg);

/// Position of each node's frame in the body frame at the zero pose.
std::vector<Vec3> node_origins(const Entity& entity);

/// Slides the joint frames of closed-form legs along their axes to where the axes meet: files may
/// put a joint anywhere on its axis, the solver needs it there. Nothing moves in the world.
void gather_leg_frames(Entity& entity);

}  // namespace verp::model
