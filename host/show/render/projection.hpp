#pragma once
#include "host/show/render/stage.hpp"

/// Projections to the picture and the sun's view; private to this folder.
namespace verp::render {

inline constexpr double kFloor_m = 120;  // edge length; beyond it all looks like the horizon

/// World to eye: right, up, back.
Mat4 look_at(const scene::Vec3& eye_m, const scene::Vec3& target_m, const scene::Vec3& up);
/// World to clip space.
Mat4 clip_of(const scene::Camera& camera, Size size);

struct View {
  scene::Vec3 eye_m = scene::Vec3::Zero();
  Mat4 clip = Mat4::Identity(), sun = Mat4::Identity();
  int shadow_light = -1;  ///< index in the scene's lights, or -1
  double sun_radius_m = 1;
  Eigen::AlignedBox2d shaded;  ///< floor in the shadow map
};

/// `shadow_light` becomes View's.
View view_of(const Stage& stage, const scene::Snapshot& now, const scene::Camera& camera, Size size,
             int shadow_light);

/// Most of a room is not in the picture. Rounded edges stay where wider than a pixel.
std::vector<Placed> in_sight(const std::vector<Placed>& placed, const scene::Camera& camera,
                             Size size);

}  // namespace verp::render
