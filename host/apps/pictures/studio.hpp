#pragma once
#include <array>
#include <functional>
#include <vector>

#include "host/apps/pictures/film.hpp"
#include "host/show/render/offscreen_context.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::pictures {

/// A renderer without a window for a film's scene. Reports what it cannot draw. Throws ToolError
/// without a driver.
class Studio {
 public:
  explicit Studio(const Film& film);
  render::Renderer& renderer() { return *renderer_; }

  using CameraOf = std::function<scene::Camera(const scene::Snapshot&, render::Size)>;
  /// Draws all states into one picture of this size, in rows of eight, numbered from 0.
  render::Image filmstrip(const std::vector<scene::Snapshot>& states, render::Size size,
                          const CameraOf& camera, const render::Effects& effects);

 private:
  std::unique_ptr<render::OffscreenContext> context_;
  std::unique_ptr<render::Renderer> renderer_;
};

/// Consecutive labels differ in hue.
std::array<std::uint8_t, 3> colour_of(int label);
render::Image coloured(const render::Measured& measured);

}  // namespace verp::pictures
