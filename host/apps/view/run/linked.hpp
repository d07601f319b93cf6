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

/// A controller at the end of a link, as its registers tell of it: at its operator's port, or as
/// the node of a CAN bus. Asked in a thread of its own, so a link that is silent or gone holds up
/// nobody; it is asked again until it answers. Writes nothing.
class Linked {
 public:
  /// Throws link::EndpointError, link::LinkError.
  Linked(const std::string& link, std::shared_ptr<const scene::Entity> entity,
         const Params& params);
  ~Linked();
  Linked(const Linked&) = delete;
  Linked& operator=(const Linked&) = delete;

  struct Told {
    bool lost = false;    ///< it was there, and is not now
    std::string trouble;  ///< why it tells nothing now; empty: it does
    std::uint64_t looks = 0, digest = 0;
    std::uint32_t tick = 0;
    double roll_rad = 0, pitch_rad = 0;
    scene::RobotView robot;  ///< as told last, without poses; no joints: never
  };
  Told told() const;

  /// That robot on its feet to the left of `own`, heading as it does. One that was never heard has
  /// no links, and is not drawn.
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
  bool known_ = false;  ///< that it is such a robot; the thread's alone
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  Told told_;
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace verp::view
