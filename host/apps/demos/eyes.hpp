#pragma once
#include <optional>
#include <vector>

#include "host/run/session/session.hpp"
#include "host/show/camera/painter.hpp"

namespace verp::demos {

/// What robots' cameras see, drawn by a program beside this one at the moment at which they look.
class Eyes {
 public:
  /// Throws camera::CameraError: it is not built, or there is no OpenGL.
  Eyes(const std::vector<const session::WalkPlan*>& plans, const sim::WorldOptions& world);

  /// What the first camera of the robot that looked saw then; nothing: it was not that one.
  std::optional<camera::Picture> look(const sim::Exposure& exposure);

 private:
  camera::Stage stage_;
  camera::Painter painter_;
};

}  // namespace verp::demos
