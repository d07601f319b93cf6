#pragma once
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::camera {

/// One camera's view as a renderer draws it, which knows plain pinholes only: a plain camera's
/// picture as it is, another's out of a wider one.
class View {
 public:
  explicit View(const model::CameraSensor& camera);

  /// What the renderer is asked for.
  scene::Camera camera(const model::Transform& link_world) const;
  render::Size drawn() const { return drawn_; }

  /// What it gave, as the camera has it.
  render::Image seen(render::Image drawn) const;
  render::Measured seen(render::Measured drawn) const;

 private:
  struct From {
    float x = 0, y = 0;  ///< in the drawn picture, pixels' centres at whole numbers
  };
  void place_pixels();
  std::size_t nearest(const From& from) const;

  model::CameraSensor camera_;
  render::Size size_, drawn_;
  double focal_px_;         ///< of the drawn one
  std::vector<From> from_;  ///< of each pixel; empty: plain
};

}  // namespace verp::camera
