#pragma once
#include <functional>
#include <memory>

#include "host/run/session/robot.hpp"

namespace verp::session {

/// Drives a robot over its bus.
class Controller {
 public:
  virtual ~Controller() = default;
  /// Runs one more tick, which ends in robot.take(); the first call brings the robot up before and
  /// throws NotUp if that fails. A controller that waits for an external one returns after some ms
  /// without a tick. False: no further tick, and robot.fail() has the reason.
  virtual bool tick() = 0;
  /// Called once when the robot is over, for last messages to the controller.
  virtual void finish() {}
  /// Wall time of this controller in a session that took `session_s`.
  virtual double wall_s(double session_s) const { return session_s; }
};

/// The controller that robot.plan() asks for: the firmware/app loop in this process, or in firmware
/// on an emulated board. For a board, the same core also runs here, for its State and Outputs and
/// to compare every digest.
std::unique_ptr<Controller> make_controller(Robot& robot);

using MakeController = std::function<std::unique_ptr<Controller>(Robot& robot)>;

}  // namespace verp::session
