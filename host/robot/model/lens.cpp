#include "host/robot/model/lens.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace verp::model {
namespace {

using Eigen::Vector2d;

Vector2d distorted(const CameraSensor& camera, const Vector2d& at) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double x = at.x(), y = at.y(), r2 = at.squaredNorm();
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

}  // namespace

Vector2d pixel_of(const CameraSensor& camera, const Vector2d& direction) {
  const Vector2d at = distorted(camera, direction);
  return {camera.fx_px * at.x() + camera.cx_px, camera.fy_px * at.y() + camera.cy_px};
}

/// Newton with numeric slopes: there is no closed-form inverse.
std::optional<Vector2d> direction_of(const CameraSensor& camera, const Vector2d& pixel) {
  constexpr int kMostSteps = 30;
  constexpr double kClose = 1e-10, kSlope = 1e-6, kLeastSlope = 1e-3;
  const Vector2d wanted((pixel.x() - camera.cx_px) / camera.fx_px,
                        (pixel.y() - camera.cy_px) / camera.fy_px);
  Vector2d at = wanted;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector2d here = distorted(camera, at);
    Eigen::Matrix2d slopes;
    slopes.col(0) = (distorted(camera, at + Vector2d(kSlope, 0)) - here) / kSlope;
    slopes.col(1) = (distorted(camera, at + Vector2d(0, kSlope)) - here) / kSlope;
    if (!(slopes.determinant() > kLeastSlope)) return std::nullopt;
    const Vector2d off = slopes.inverse() * (wanted - here);
    at += off;
    if (off.norm() < kClose) return at;
  }
  return std::nullopt;
}

bool is_plain(const CameraSensor& camera) {
  const auto same = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  for (const double part : camera.distortion) {
    if (part != 0) return false;
  }
  return same(camera.fx_px, camera.fy_px) && same(camera.cx_px, camera.width_px / 2.0 - 0.5) &&
         same(camera.cy_px, camera.height_px / 2.0 - 0.5);
}

Vec3 in_lens(const CameraSensor& camera, const Vec3& point_link_m) {
  const Vec3 seen = camera.pose.inverse() * point_link_m;
  return {-seen.y(), -seen.z(), seen.x()};
}

}  // namespace verp::model
