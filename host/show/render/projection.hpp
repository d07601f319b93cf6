#pragma once
#include "host/show/render/stage.hpp"

/// Projections to the picture and to the sun's view. Private to this folder.
namespace verp::render {

inline constexpr double kFloor_m = 120;  // edge length; beyond it everything looks like the horizon

/// World to eye: right, up, back.
Mat4 look_at(const scene::Vec3& eye_m, const scene::Vec3& target_m, const scene::Vec3& up);
/// World to clip space.
Mat4 clip_of(const scene::Camera& camera, Size size);

/// Shared by all passes of a picture.
struct View {
  scene::Vec3 eye_m = scene::Vec3::Zero();
  Mat4 clip = Mat4::Identity(), sun = Mat4::Identity();
  int shadow_light = -1;  ///< in the scene's lights, or -1
  double sun_radius_m = 1;
  Eigen::AlignedBox2d shaded;  ///< floor area in the shadow map
};

/// `shadow_light` becomes View's.
View view_of(const Stage& stage, const scene::Snapshot& now, const scene::Camera& camera, Size size,
             int shadow_light);

/// The items that may be in the picture: most of a room is not. Rounded edges stay only where wider
/// than a pixel.
std::vector<Placed> in_sight(const std::vector<Placed>& placed, const scene::Camera& camera,
                             Size size);

}  // namespace verp::render
