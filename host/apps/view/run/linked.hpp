#pragma once
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "common/model/params.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::view {

/// Reads a controller's registers by its operator's port or CAN node; writes nothing. Its own
/// thread polls, so a dead link delays no one else.
class Linked {
 public:
  /// Throws link::EndpointError, link::LinkError.
  Linked(const std::string& link, std::shared_ptr<const scene::Entity> entity,
         const Params& params);
  ~Linked();
  Linked(const Linked&) = delete;
  Linked& operator=(const Linked&) = delete;

  struct Told {
    bool lost = false;    ///< answered once, but not now
    std::string trouble;  ///< why there is no answer; or empty
    std::uint64_t looks = 0, digest = 0;
    std::uint32_t tick = 0;
    double roll_rad = 0, pitch_rad = 0;
    scene::RobotView robot;  ///< without poses; no joints before an answer
  };
  Told told() const;

  /// The robot on its feet to the left of `own`, with its heading. Without links, so not drawn,
  /// before an answer.
  scene::RobotView beside(const scene::RobotView& own) const;

 private:
  class Registers;
  class Serial;
  class Can;

  void loop();
  Told look();
  void require_same_robot();

  const std::shared_ptr<const scene::Entity> entity_;
  const Params params_;
  std::unique_ptr<Registers> registers_;
  bool known_ = false;  ///< a robot like ours; thread only
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  Told told_;
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace verp::view
