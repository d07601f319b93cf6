#pragma once
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// From where a picture is made.
struct Camera {
  Vec3 eye_m = Vec3(1.2, -1.2, 0.8);
  Vec3 target_m = Vec3(0, 0, 0.25);
  Vec3 up = Vec3::UnitZ();
  double vertical_fov_rad = 0.5;
  double near_m = 0.02, far_m = 60;
};

/// A camera on a ball around what it looks at: what a mouse turns.
struct Orbit {
  Vec3 target_m = Vec3(0, 0, 0.25);
  double azimuth_rad = -0.65;   ///< 0: from ahead of a robot that looks along x; to its left
  double elevation_rad = 0.28;  ///< 0: level
  double distance_m = 1.6;
  double vertical_fov_rad = 0.5;

  Camera camera() const;
  /// By so many radians; never over the top.
  void turn(double azimuth_rad, double elevation_rad);
  /// In the picture's plane, in heights of the picture: what is under the mouse stays there.
  void pan(double right, double up);
  void zoom(double factor);
};

/// front, side, three-quarter, back, top, follow, head, and the names of the scene's cameras.
std::vector<std::string> view_names(const Scene& scene);

/// One of them, of one robot; width / height of the picture decides how far it must stand off.
/// None: there is no such view. The horizontal field of a declared camera is kept.
std::optional<Camera> view(const std::string& name, const Scene& scene, const Snapshot& now,
                           int robot, double aspect);

}  // namespace verp::scene
