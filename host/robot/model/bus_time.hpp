#pragma once
#include <cstddef>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

struct BusTime {
  double us = 0;          ///< worst case
  double share = 0;       ///< of the control period
  double change_us = 0;   ///< all servos change state
  std::size_t bytes = 0;  ///< serial; on CAN 0
  std::size_t bits = 0;   ///< worst stuffing; serial: 10 a byte
};
BusTime bus_time(const Params& params);

/// The only check that admits a robot to its bus: a tick may take 80 % of the period, one in which
/// all servos change state 100 %. Throws LoadError at <verp:bus> with the first servo that does not
/// fit. `params`: the entity's, or with another period.
void require_bus(const Entity& entity, const Params& params);

}  // namespace verp::model
