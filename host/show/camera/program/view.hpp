#pragma once
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::camera {

/// One camera's view. Renderers draw plain pinholes only, so a distorted camera's picture is
/// sampled from a wider pinhole's.
class View {
 public:
  explicit View(const model::CameraSensor& camera);

  /// The camera and size to render.
  scene::Camera camera(const model::Transform& link_world) const;
  render::Size drawn() const { return drawn_; }

  /// Converts the rendered picture to the camera's.
  render::Image seen(render::Image drawn) const;
  render::Measured seen(render::Measured drawn) const;

 private:
  struct From {
    float x = 0, y = 0;  ///< in the rendered picture, pixel centres at integers
  };
  void place_pixels();
  std::size_t nearest(const From& from) const;

  model::CameraSensor camera_;
  render::Size size_, drawn_;
  double focal_px_;         ///< of the rendered picture
  std::vector<From> from_;  ///< one per pixel; empty: no distortion
};

}  // namespace verp::camera
