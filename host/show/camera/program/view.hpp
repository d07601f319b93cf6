#pragma once
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::camera {

/// Renderers draw plain pinholes; a distorted picture is sampled from a wider one.
class View {
 public:
  explicit View(const model::CameraSensor& camera);

  scene::Camera camera(const model::Transform& link_world) const;
  render::Size drawn() const { return drawn_; }

  /// Converts the rendered picture to the camera's.
  render::Image seen(render::Image drawn) const;
  render::Measured seen(render::Measured drawn) const;

 private:
  struct From {
    float x = 0, y = 0;  ///< pixel centres at integers
  };
  void place_pixels();
  std::size_t nearest(const From& from) const;

  model::CameraSensor camera_;
  render::Size size_, drawn_;
  double focal_px_;         ///< of the rendered picture
  std::vector<From> from_;  ///< per pixel; empty: no distortion
};

}  // namespace verp::camera
