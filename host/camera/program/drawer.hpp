#pragma once
#include <deque>
#include <memory>
#include <vector>

#include "host/camera/program/view.hpp"
#include "host/camera/wire.hpp"
#include "host/render/offscreen_context.hpp"
#include "host/render/renderer.hpp"
#include "host/sim/random.hpp"

namespace verp::camera {

/// A stage's scene in a renderer, and the first robot's cameras in it.
class Drawer {
 public:
  /// Throws LoadError and RenderError.
  explicit Drawer(const Stage& stage);

  /// What that camera sees in that moment: one picture, of colour with depth two. The same
  /// whatever else was drawn: noise hangs on the seed, the camera and the time.
  std::vector<Picture> draw(const Moment& moment, std::uint32_t camera);
  std::size_t cameras() const { return cameras_.size(); }

 private:
  Picture colour(const scene::Snapshot& now, const scene::Camera& from, std::uint32_t camera,
                 sim::Random& random);
  void add_measured(const scene::Snapshot& now, const scene::Camera& from, std::uint32_t camera,
                    sim::Random& random, std::vector<Picture>& out);

  const std::uint64_t seed_;
  std::vector<model::CameraSensor> cameras_;
  std::vector<View> views_;
  scene::Scene scene_;
  render::OffscreenContext context_;
  render::Renderer renderer_;
};

}  // namespace verp::camera
