#pragma once
#include "host/show/render/stage.hpp"

/// From the world to a picture, and to what the sun sees. Private to this folder.
namespace verp::render {

inline constexpr double kFloor_m = 120;  // edges; what is further away is horizon anyway

/// World to eye: right, up, back.
Mat4 look_at(const scene::Vec3& eye_m, const scene::Vec3& target_m, const scene::Vec3& up);
/// World to clip space.
Mat4 clip_of(const scene::Camera& camera, Size size);

/// What a picture's passes have in common.
struct View {
  scene::Vec3 eye_m = scene::Vec3::Zero();
  Mat4 clip = Mat4::Identity(), sun = Mat4::Identity();
  int shadow_light = -1;  ///< of the scene's; -1: none
  double sun_radius_m = 1;
  Eigen::AlignedBox2d shaded;  ///< of the floor: what the shadow map covers
};

/// `shadow_light`: View's.
View view_of(const Stage& stage, const scene::Snapshot& now, const scene::Camera& camera, Size size,
             int shadow_light);

/// Those of `placed` of which something may be in the picture, and whose rounded edges only where
/// they are wider than a pixel: most of a room is beside or behind a camera, and far away.
std::vector<Placed> in_sight(const std::vector<Placed>& placed, const scene::Camera& camera,
                             Size size);

}  // namespace verp::render
