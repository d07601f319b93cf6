#include "host/show/scene/camera.hpp"

#include <algorithm>
#include <cmath>

namespace verp::scene {
namespace {

using std::numbers::pi;

struct Preset {
  const char* name;
  double azimuth_rad, elevation_rad;
};
constexpr Preset kPresets[] = {{"three-quarter", -0.62, 0.22},
                               {"front", 0, 0.10},
                               {"side", -pi / 2, 0.10},
                               {"back", pi, 0.14},
                               {"top", 0, 1.54},
                               {"follow", pi - 0.5, 0.32}};

Vec3 around(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

double heading_rad(const Transform& body) {
  const Vec3 ahead = body.linear().col(0);
  return std::atan2(ahead.y(), ahead.x());
}

/// The width of what is drawn of a standing robot, about its middle: arms may reach far to the
/// sides.
double width_m(const Robot& robot, double azimuth_rad) {
  double half_m = 0;
  for (const double x_m : {robot.drawn_m.min().x(), robot.drawn_m.max().x()}) {
    for (const double y_m : {robot.drawn_m.min().y(), robot.drawn_m.max().y()}) {
      half_m =
          std::max(half_m, std::abs(y_m * std::cos(azimuth_rad) - x_m * std::sin(azimuth_rad)));
    }
  }
  return 2 * half_m;
}

Camera through(const Mount& mount, const Snapshot& now, double aspect) {
  Transform pose = mount.pose;
  if (mount.robot != kWorld) {
    const RobotView& robot = now.robots[static_cast<std::size_t>(mount.robot)];
    pose = robot.link_world[static_cast<std::size_t>(mount.node)] * mount.pose;
  }
  Camera camera;
  // The eye is ahead of the drawn lens and its rim.
  camera.eye_m = pose * Vec3(0.008, 0, 0);
  camera.target_m = pose * Vec3(1, 0, 0);
  camera.up = pose.linear().col(2);
  camera.vertical_fov_rad = 2 * std::atan(std::tan(mount.horizontal_fov_rad / 2) / aspect);
  camera.near_m = std::max(mount.near_m, 1e-3);
  camera.far_m = std::max(mount.far_m, 2 * camera.near_m);
  return camera;
}

}  // namespace

Camera Orbit::camera() const {
  Camera camera;
  camera.target_m = target_m;
  camera.eye_m = target_m + distance_m * around(azimuth_rad, elevation_rad);
  camera.vertical_fov_rad = vertical_fov_rad;
  camera.near_m = std::max(0.005, distance_m / 100);
  camera.far_m = distance_m + 80;
  return camera;
}

void Orbit::turn(double by_azimuth_rad, double by_elevation_rad) {
  azimuth_rad = std::remainder(azimuth_rad + by_azimuth_rad, 2 * pi);
  elevation_rad = std::clamp(elevation_rad + by_elevation_rad, -1.54, 1.54);
}

void Orbit::pan(double right, double up) {
  const double height_m = 2 * distance_m * std::tan(vertical_fov_rad / 2);
  const Vec3 back = around(azimuth_rad, elevation_rad);
  const Vec3 to_right = Vec3::UnitZ().cross(back).normalized();
  target_m += height_m * (right * to_right + up * back.cross(to_right));
}

void Orbit::zoom(double factor) {
  distance_m = std::clamp(distance_m * factor, 0.05, 50.0);
}

std::vector<std::string> view_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.push_back(preset.name);
  if (std::any_of(scene.cameras.begin(), scene.cameras.end(),
                  [](const Mount& mount) { return mount.robot != kWorld; })) {
    names.push_back("head");
  }
  for (const Mount& mount : scene.cameras) names.push_back(mount.name);
  return names;
}

std::optional<Camera> view(const std::string& name, const Scene& scene, const Snapshot& now,
                           int robot, double aspect) {
  for (const Mount& mount : scene.cameras) {
    const bool own = mount.robot == robot && (mount.name == name || name == "head");
    if (own || (mount.robot == kWorld && mount.name == name)) return through(mount, now, aspect);
  }
  const auto* preset = std::find_if(std::begin(kPresets), std::end(kPresets),
                                    [&](const Preset& p) { return p.name == name; });
  if (preset == std::end(kPresets)) return std::nullopt;
  const double height_m = scene.robots[static_cast<std::size_t>(robot)].height_m;
  const Transform& body = now.robots[static_cast<std::size_t>(robot)].link_world.front();
  Orbit orbit;
  orbit.target_m = {body.translation().x(), body.translation().y(), 0.485 * height_m};
  orbit.azimuth_rad = heading_rad(body) + preset->azimuth_rad;
  orbit.elevation_rad = preset->elevation_rad;
  orbit.vertical_fov_rad = 0.45;
  const double tall_m = 1.28 * height_m;
  const double wide_m =
      std::max(0.95 * height_m,
               1.15 * width_m(scene.robots[static_cast<std::size_t>(robot)], preset->azimuth_rad));
  orbit.distance_m = std::max(tall_m, wide_m / aspect) / (2 * std::tan(orbit.vertical_fov_rad / 2));
  return orbit.camera();
}

}  // namespace verp::scene
