#pragma once
#include <map>
#include <vector>

#include "host/show/camera/program/view.hpp"
#include "host/show/camera/wire.hpp"
#include "host/show/render/offscreen_context.hpp"
#include "host/show/render/renderer.hpp"
#include "host/twin/sim/random.hpp"

namespace verp::camera {

/// A stage's scene, the robots' cameras in it, and a renderer for each robot whose cameras look.
class Drawer {
 public:
  /// Throws LoadError and RenderError.
  explicit Drawer(const Stage& stage);

  /// What that camera of moment.robot sees: one picture, of colour with depth two. The same
  /// whatever else was drawn: noise hangs on the robot's seed, the camera and the time. Throws
  /// std::invalid_argument: the stage has no such robot, or link.
  std::vector<Picture> draw(const Moment& moment, std::uint32_t camera);
  /// What somebody beside the robots sees. Throws std::invalid_argument: there is no such view.
  Picture draw(const Moment& moment, const Outside& from);

 private:
  struct Eyes {
    std::uint64_t seed = 1;  ///< of their noise
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

  std::vector<Eyes> eyes_;  ///< of each robot
  scene::Scene scene_;
  std::vector<std::string> names_;  ///< of its labels, once somebody looks for them
  render::OffscreenContext context_;
  std::map<int, render::Renderer> renderers_;  ///< of a robot that looks; of kWorld: from outside
};

}  // namespace verp::camera
