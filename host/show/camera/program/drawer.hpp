#pragma once
#include <map>
#include <vector>

#include "host/show/camera/program/view.hpp"
#include "host/show/camera/wire.hpp"
#include "host/show/render/offscreen_context.hpp"
#include "host/show/render/renderer.hpp"
#include "host/twin/sim/random.hpp"

namespace verp::camera {

/// A scene, its cameras, and a renderer per robot that looks.
class Drawer {
 public:
  /// Throws LoadError and RenderError.
  explicit Drawer(const Stage& stage);

  /// One picture, with depth two. Noise depends only on the robot's seed, the camera and the time.
  /// Throws std::invalid_argument for an unknown robot or link.
  std::vector<Picture> draw(const Moment& moment, std::uint32_t camera);
  /// From outside. Throws std::invalid_argument for an unknown view.
  Picture draw(const Moment& moment, const Outside& from);

 private:
  struct Eyes {
    std::uint64_t seed = 1;  ///< for noise
    std::vector<model::CameraSensor> cameras;
    std::vector<View> views;
  };
  void add_robot(const Stage::Robot& robot);
  std::vector<std::string> label_names() const;
  scene::Snapshot shown(const Moment& moment) const;
  render::Renderer& renderer_of(int robot);
  Picture colour(const scene::Snapshot& now, const scene::Camera& from, const Moment& moment,
                 std::uint32_t camera, sim::Random& random);
  Picture measured(const scene::Snapshot& now, const scene::Camera& from, const Moment& moment,
                   std::uint32_t camera, sim::Random& random);

  std::vector<Eyes> eyes_;  ///< one per robot
  scene::Scene scene_;
  std::vector<std::string> names_;  ///< labels, by first use
  render::OffscreenContext context_;
  std::map<int, render::Renderer> renderers_;  ///< by robot; kWorld: from outside
};

}  // namespace verp::camera
