#include "host/show/camera/program/view.hpp"

#include <algorithm>
#include <cmath>

#include "host/robot/model/lens.hpp"

namespace verp::camera {

using Eigen::Vector2d;

View::View(const model::CameraSensor& camera)
    : camera_(camera),
      size_{camera.width_px, camera.height_px},
      drawn_(size_),
      focal_px_(camera.fx_px) {
  if (!model::is_plain(camera)) place_pixels();
}

/// A wider pinhole, as fine as the camera in the middle.
void View::place_pixels() {
  constexpr double kMost_px = 4096, kMargin_px = 2;
  std::vector<Vector2d> direction;
  Vector2d widest(0, 0);
  for (int y = 0; y < size_.height; ++y) {
    for (int x = 0; x < size_.width; ++x) {
      // The loader has checked the edge, where distortion is strongest.
      direction.push_back(model::direction_of(camera_, Vector2d(x, y)).value_or(Vector2d(0, 0)));
      widest = widest.cwiseMax(direction.back().cwiseAbs());
    }
  }
  focal_px_ = std::min(std::max(camera_.fx_px, camera_.fy_px),
                       (kMost_px / 2 - kMargin_px) / widest.maxCoeff());
  const auto edge = [&](double tangent) {
    return 2 * static_cast<int>(std::ceil(focal_px_ * tangent + kMargin_px));
  };
  drawn_ = {edge(widest.x()), edge(widest.y())};
  for (const Vector2d& at : direction) {
    from_.push_back({static_cast<float>(focal_px_ * at.x() + drawn_.width / 2.0 - 0.5),
                     static_cast<float>(focal_px_ * at.y() + drawn_.height / 2.0 - 0.5)});
  }
}

scene::Camera View::camera(const model::Transform& link_world) const {
  const model::Transform pose = link_world * camera_.pose;
  scene::Camera out;
  out.eye_m = pose.translation();
  out.target_m = pose * model::Vec3(1, 0, 0);
  out.up = pose.linear().col(2);
  out.vertical_fov_rad = 2 * std::atan(drawn_.height / (2 * focal_px_));
  out.near_m = camera_.near_m;
  out.far_m = camera_.far_m;
  return out;
}

render::Image View::seen(render::Image drawn) const {
  if (from_.empty()) return drawn;
  render::Image out{size_, std::vector<std::uint8_t>(3 * from_.size())};
  const auto row = static_cast<std::size_t>(3 * drawn.size.width);
  for (std::size_t i = 0; i < from_.size(); ++i) {
    const float left = std::floor(from_[i].x), top = std::floor(from_[i].y);
    const float right = from_[i].x - left, down = from_[i].y - top;
    const std::uint8_t* at =
        drawn.rgb.data() + static_cast<std::size_t>(top) * row + 3 * static_cast<std::size_t>(left);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = [&](std::size_t offset) { return static_cast<float>(at[offset + k]); };
      const float above = value(0) + right * (value(3) - value(0));
      const float below = value(row) + right * (value(row + 3) - value(row));
      out.rgb[3 * i + k] = static_cast<std::uint8_t>(above + down * (below - above) + 0.5F);
    }
  }
  return out;
}

std::size_t View::nearest(const From& from) const {
  return static_cast<std::size_t>(std::lround(from.y)) * static_cast<std::size_t>(drawn_.width) +
         static_cast<std::size_t>(std::lround(from.x));
}

/// A mean of two depths or labels would be neither.
render::Measured View::seen(render::Measured drawn) const {
  if (from_.empty()) return drawn;
  render::Measured out{size_, {}, {}};
  for (const From& from : from_) {
    const std::size_t at = nearest(from);
    out.depth_m.push_back(drawn.depth_m[at]);
    out.label.push_back(drawn.label[at]);
  }
  return out;
}

}  // namespace verp::camera
