#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "host/link/system_clock.hpp"
#include "host/session/robot.hpp"

namespace verp::tool {

/// Watches the robot of a controller that tells nothing, and says when its session begins.
class RobotWatch {
 public:
  using Say = std::function<void(const std::string&)>;

  RobotWatch(session::Robot& robot, Say say) : robot_(robot), say_(std::move(say)) {}

  /// Once per tick.
  void see() {
    robot_.watch();
    const session::FallVerdict& verdict = robot_.verdict();
    if (verdict.driven() && drive_ns_ == 0) {
      drive_ns_ = wire::monotonic_ns();
      say_("a servo has torque: the session begins");
    }
    if (verdict.lay_down() && !std::exchange(lay_down_, true)) {
      say_("the robot was let go and lies down: that is no fall, and it is served on");
    }
  }
  /// All ticks of `period_us` up to bus time `now_us`, until the session is over.
  void see_until(std::uint64_t now_us, std::uint32_t period_us) {
    while (now_us >= next_us_ && !robot_.over()) {
      see();
      next_us_ += period_us;
    }
  }
  /// By the monotonic clock, when torque was first seen; 0: not yet.
  std::uint64_t drive_ns() const { return drive_ns_; }

 private:
  session::Robot& robot_;
  Say say_;
  std::uint64_t drive_ns_ = 0;
  std::uint64_t next_us_ = 0;
  bool lay_down_ = false;
};

}  // namespace verp::tool
