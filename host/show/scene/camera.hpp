#pragma once
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

struct Camera {
  Vec3 eye_m = Vec3(1.2, -1.2, 0.8);
  Vec3 target_m = Vec3(0, 0, 0.25);
  Vec3 up = Vec3::UnitZ();
  double vertical_fov_rad = 0.5;
  double near_m = 0.02, far_m = 60;
};

/// A camera on a sphere around its target, turned by the mouse.
struct Orbit {
  Vec3 target_m = Vec3(0, 0, 0.25);
  double azimuth_rad = -0.65;   ///< 0: from ahead of a robot along x; positive: from its left
  double elevation_rad = 0.28;  ///< 0: level
  double distance_m = 1.6;
  double vertical_fov_rad = 0.5;

  Camera camera() const;
  /// Angles in radians; stops short of the pole.
  void turn(double azimuth_rad, double elevation_rad);
  /// In picture heights: the point under the mouse stays.
  void pan(double right, double up);
  void zoom(double factor);
};

/// front, side, three-quarter, back, top, follow, head, and the scene's cameras.
std::vector<std::string> view_names(const Scene& scene);

/// Empty: unknown. `aspect`: width / height, sets the distance. A declared camera keeps its
/// horizontal field.
std::optional<Camera> view(const std::string& name, const Scene& scene, const Snapshot& now,
                           int robot, double aspect);

}  // namespace verp::scene
