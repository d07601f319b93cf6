#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "host/run/session/session.hpp"
#include "host/show/camera/painter.hpp"

namespace verp::abi {

/// Keeps each camera's last time and poses, and draws on request.
class Sight {
 public:
  explicit Sight(const sim::WorldOptions& world);

  void add(const session::WalkPlan& plan);
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
  std::vector<std::vector<Look>> last_;       ///< by robot, by camera
  std::unique_ptr<camera::Painter> painter_;  ///< made by the first request
};

}  // namespace verp::abi
