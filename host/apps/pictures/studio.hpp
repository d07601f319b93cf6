#pragma once
#include <array>
#include <functional>
#include <vector>

#include "host/apps/pictures/film.hpp"
#include "host/show/render/offscreen_context.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::pictures {

/// Renders a film's scene without a window. Throws ToolError without a driver.
class Studio {
 public:
  explicit Studio(const Film& film);
  render::Renderer& renderer() { return *renderer_; }

  using CameraOf = std::function<scene::Camera(const scene::Snapshot&, render::Size)>;
  /// All states in rows of eight, numbered from 0.
  render::Image filmstrip(const std::vector<scene::Snapshot>& states, render::Size size,
                          const CameraOf& camera, const render::Effects& effects);

 private:
  std::unique_ptr<render::OffscreenContext> context_;
  std::unique_ptr<render::Renderer> renderer_;
};

std::array<std::uint8_t, 3> colour_of(int label);
render::Image coloured(const render::Measured& measured);

}  // namespace verp::pictures
