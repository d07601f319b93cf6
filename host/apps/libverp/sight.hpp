#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "host/run/session/session.hpp"
#include "host/show/camera/painter.hpp"

namespace verp::abi {

/// Camera pictures and renderings of a session. Keeps each camera's last time and the poses at that
/// time, and draws a picture on request.
class Sight {
 public:
  explicit Sight(const sim::WorldOptions& world);

  void add(const session::WalkPlan& plan);
  /// Notes the cameras that took a picture in the robot's tick.
  void looked(session::Session& session, std::uint32_t robot);

  /// The camera's last picture in that encoding (camera::Picture); null: none taken yet. Throws
  /// CameraError.
  const camera::Picture* picture(std::uint32_t robot, std::uint32_t camera, const char* encoding);
  /// Draws the world as it is now. Throws CameraError, and std::invalid_argument for an unknown
  /// view.
  camera::Picture render(session::Session& session, std::uint32_t robot,
                         const camera::Outside& from);

 private:
  struct Look {
    std::shared_ptr<const camera::Moment> at;  ///< null: none taken yet
    std::vector<camera::Picture> drawn;        ///< empty: not drawn yet
  };
  camera::Painter& painter();

  camera::Stage stage_;
  std::vector<std::vector<Look>> last_;       ///< by robot, then by camera
  std::unique_ptr<camera::Painter> painter_;  ///< created by the first request
};

}  // namespace verp::abi
