#pragma once
#include <cstddef>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// What one tick's frames take of a robot's bus, whichever protocol it speaks.
struct BusTime {
  double us = 0;          ///< on the wire, at worst
  double share = 0;       ///< of the control period
  double change_us = 0;   ///< of a tick in which all servos change their state
  std::size_t bytes = 0;  ///< serial; on CAN 0
  std::size_t bits = 0;   ///< with worst stuffing; serial: 10 a byte
};
BusTime bus_time(const Params& params);

/// The one place that admits a robot to its bus: a tick may take 80 % of the period, one in which
/// all servos change their state all of it. Throws LoadError at the robot's <verp:bus>, which names
/// the first servo that there is no room for. `params`: the entity's, perhaps with another period.
void require_bus(const Entity& entity, const Params& params);

}  // namespace verp::model
