#pragma once
#include <optional>
#include <vector>

#include "host/run/session/session.hpp"
#include "host/show/camera/painter.hpp"

namespace verp::demos {

/// Pictures of the robots' cameras, drawn by another program at the time of exposure.
class Eyes {
 public:
  /// Throws camera::CameraError if that program is not built or there is no OpenGL.
  Eyes(const std::vector<const session::WalkPlan*>& plans, const sim::WorldOptions& world);

  /// Picture of the robot's first camera; empty if another camera was exposed.
  std::optional<camera::Picture> look(const sim::Exposure& exposure);

 private:
  camera::Stage stage_;
  camera::Painter painter_;
};

}  // namespace verp::demos
