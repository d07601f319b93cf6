#pragma once
#include <functional>
#include <memory>

#include "host/run/session/robot.hpp"

namespace verp::session {

/// Who drives a robot over its bus.
class Controller {
 public:
  virtual ~Controller() = default;
  /// One more tick, which ends in robot.take(); the first brings the robot up before. Throws NotUp
  /// if it does not come. One that waits for somebody outside comes back after some ms without a
  /// tick. False: there is no further one, and robot.fail() was told why.
  virtual bool tick() = 0;
  /// The robot is over: what is still to be said to the controller, once.
  virtual void finish() {}
  /// How long it took, if the session took `session_s`.
  virtual double wall_s(double session_s) const { return session_s; }
};

/// The controller that robot.plan() asks for: the firmware/app loop, in this process, or in
/// firmware on an emulated board. There the same core runs along here, for its State and Outputs
/// and to hold every digest against the board's.
std::unique_ptr<Controller> make_controller(Robot& robot);

using MakeController = std::function<std::unique_ptr<Controller>(Robot& robot)>;

}  // namespace verp::session
