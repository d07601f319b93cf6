#pragma once
#include "boards/stm32/hardware.hpp"
#include "boards/stm32/servo_power.hpp"
#include "common/model/params.hpp"

namespace verp::board {

/// The robot's port before there is a loop, and the power switch.
struct Servos {
  /// Without a robot the baud rate is unknown.
  bool open() { return has_robot && open_robot_port(start, params.baud); }
  void power(bool on) { supply.set(on); }
  void release() { RobotSide::release(robot_port, params.bus_protocol); }

  const Start& start;
  const Params& params;
  bool has_robot;
  ServoPower<Io>& supply;
};

}  // namespace verp::board
