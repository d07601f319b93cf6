#pragma once
#include <functional>
#include <memory>

#include "host/run/session/robot.hpp"

namespace verp::session {

class Controller {
 public:
  virtual ~Controller() = default;
  /// Runs a tick, which ends in robot.take(); the first call brings the robot up and throws NotUp
  /// on failure. Waiting for an external controller, it returns after some ms without a tick.
  /// False: the end; robot.fail() has the reason.
  virtual bool tick() = 0;
  /// Called once when the robot is over, for last messages to the controller.
  virtual void finish() {}
  /// Wall time in a session of `session_s`.
  virtual double wall_s(double session_s) const { return session_s; }
};

/// The firmware/app loop in this process, or on an emulated board; for a board the core also runs
/// here, for State and Outputs and to compare digests.
std::unique_ptr<Controller> make_controller(Robot& robot);

using MakeController = std::function<std::unique_ptr<Controller>(Robot& robot)>;

}  // namespace verp::session
