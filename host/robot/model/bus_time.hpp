#pragma once
#include <cstddef>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Bus time of one tick's frames, for any protocol.
struct BusTime {
  double us = 0;          ///< on the wire, worst case
  double share = 0;       ///< of the control period
  double change_us = 0;   ///< for a tick in which all servos change state
  std::size_t bytes = 0;  ///< serial; on CAN 0
  std::size_t bits = 0;   ///< with worst stuffing; serial: 10 a byte
};
BusTime bus_time(const Params& params);

/// The only check that admits a robot to its bus. A tick may take 80 % of the period; a tick in
/// which all servos change state may take 100 %. Throws LoadError at the robot's <verp:bus> with
/// the first servo that does not fit. `params`: the entity's, possibly with another period.
void require_bus(const Entity& entity, const Params& params);

}  // namespace verp::model
