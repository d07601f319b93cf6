#include "host/show/render/projection.hpp"

#include <cmath>

namespace verp::render {

using scene::Vec2;
using scene::Vec3;
using Area = Eigen::AlignedBox2d;

Mat4 look_at(const Vec3& eye_m, const Vec3& target_m, const Vec3& up) {
  const Vec3 back = (eye_m - target_m).normalized();
  Vec3 right = up.cross(back);
  if (right.norm() < 1e-6) right = back.unitOrthogonal();
  right.normalize();
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = right.transpose();
  view.block<1, 3>(1, 0) = back.cross(right).transpose();
  view.block<1, 3>(2, 0) = back.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye_m;
  return view.cast<float>();
}

namespace {

Mat4 perspective(const scene::Camera& camera, Size size) {
  const auto near_m = static_cast<float>(camera.near_m), far_m = static_cast<float>(camera.far_m);
  const auto scale = static_cast<float>(1 / std::tan(camera.vertical_fov_rad / 2));
  Mat4 clip = Mat4::Zero();
  clip(0, 0) = scale * static_cast<float>(size.height) / static_cast<float>(size.width);
  clip(1, 1) = scale;
  clip(2, 2) = (far_m + near_m) / (near_m - far_m);
  clip(2, 3) = 2 * far_m * near_m / (near_m - far_m);
  clip(3, 2) = -1;
  return clip;
}

/// Orthographic projection along the light, over a ball.
Mat4 sun_of(const Vec3& direction, const Stage::Ball& ball) {
  const Vec3 toward = direction.normalized();
  const Mat4 view = look_at(ball.centre_m - 2 * ball.radius_m * toward, ball.centre_m,
                            std::abs(toward.z()) > 0.99 ? Vec3::UnitX() : Vec3::UnitZ());
  const auto radius_m = static_cast<float>(ball.radius_m);
  Mat4 clip = Mat4::Identity();
  clip(0, 0) = clip(1, 1) = 1 / radius_m;
  clip(2, 2) = -1 / (2 * radius_m);
  clip(2, 3) = -1;
  return clip * view;
}

/// Floor that light past the ball's box reaches.
Area shaded_by(const Mat4& sun, const Vec3& direction, const Stage::Ball& ball) {
  Area area;
  const Vec3 toward = direction.normalized();
  if (toward.z() > -0.05) return {Vec2(-kFloor_m, -kFloor_m), Vec2(kFloor_m, kFloor_m)};
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vec3 across = sun.block<1, 3>(0, 0).transpose().cast<double>().normalized(),
                 up = sun.block<1, 3>(1, 0).transpose().cast<double>().normalized();
      const Vec3 corner = ball.centre_m + ball.radius_m * (x * across + y * up);
      area.extend((corner - corner.z() / toward.z() * toward).head<2>());
    }
  }
  return area;
}

}  // namespace

Mat4 clip_of(const scene::Camera& camera, Size size) {
  return perspective(camera, size) * look_at(camera.eye_m, camera.target_m, camera.up);
}

std::vector<Placed> in_sight(const std::vector<Placed>& placed, const scene::Camera& camera,
                             Size size) {
  const Mat4 clip = clip_of(camera, size);
  // Inside, w + x, w - x, w + y, ... are positive: six planes.
  Eigen::Matrix<float, 6, 4> planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes.row(2 * axis) = clip.row(3) + clip.row(axis);
    planes.row(2 * axis + 1) = clip.row(3) - clip.row(axis);
  }
  for (int i = 0; i < 6; ++i) planes.row(i) /= planes.row(i).head<3>().norm();
  const auto focal_px =
      static_cast<float>(size.height / (2 * std::tan(camera.vertical_fov_rad / 2)));
  std::vector<Placed> out;
  for (const Placed& item : placed) {
    Eigen::AlignedBox3f box(item.mesh->around().min().cwiseProduct(item.scale));
    box.extend(item.mesh->around().max().cwiseProduct(item.scale));
    const Eigen::Vector4f centre = item.world * box.center().homogeneous();
    if ((planes * centre).minCoeff() < -box.diagonal().norm() / 2) continue;
    out.push_back(item);
    const Eigen::Vector3f eye = item.world.block<3, 3>(0, 0).transpose() *
                                (camera.eye_m.cast<float>() - item.world.block<3, 1>(0, 3));
    const float round_px_m = static_cast<float>(item.item->round_m) * focal_px;
    if (item.sharp != nullptr && round_px_m < box.exteriorDistance(eye))
      out.back().mesh = item.sharp;
  }
  return out;
}

View view_of(const Stage& stage, const scene::Snapshot& now, const scene::Camera& camera, Size size,
             int shadow_light) {
  const Stage::Ball ball = stage.extent(now, camera);
  View view;
  view.eye_m = camera.eye_m;
  view.clip = clip_of(camera, size);
  view.sun_radius_m = ball.radius_m;
  view.shadow_light = shadow_light;
  if (view.shadow_light >= 0) {
    const auto light = static_cast<std::size_t>(view.shadow_light);
    const Vec3& direction = stage.scene().lights[light].direction;
    view.sun = sun_of(direction, ball);
    view.shaded = shaded_by(view.sun, direction, ball);
  }
  return view;
}

}  // namespace verp::render
