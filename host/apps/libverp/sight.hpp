#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "host/run/session/session.hpp"
#include "host/show/camera/painter.hpp"

namespace verp::abi {

/// What a session's robots see, and what they look like: keeps when each camera last looked and
/// where everything was then, and has it drawn when somebody asks.
class Sight {
 public:
  explicit Sight(const sim::WorldOptions& world);

  /// One more robot.
  void add(const session::WalkPlan& plan);
  /// The robot has done a tick, in which its cameras may have looked.
  void looked(session::Session& session, std::uint32_t robot);

  /// What that camera last saw, in that encoding (camera::Picture); null: it has not looked yet.
  /// Throws CameraError.
  const camera::Picture* picture(std::uint32_t robot, std::uint32_t camera, const char* encoding);
  /// The world as it is. Throws CameraError, and std::invalid_argument if there is no such view.
  camera::Picture render(session::Session& session, std::uint32_t robot,
                         const camera::Outside& from);

 private:
  struct Look {
    std::shared_ptr<const camera::Moment> at;  ///< null: never
    std::vector<camera::Picture> drawn;        ///< empty: nobody has asked
  };
  camera::Painter& painter();

  camera::Stage stage_;
  std::vector<std::vector<Look>> last_;       ///< of each robot, of each of its cameras
  std::unique_ptr<camera::Painter> painter_;  ///< since somebody asked
};

}  // namespace verp::abi
