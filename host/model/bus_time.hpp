#pragma once
#include <cstddef>

#include "common/model/params.hpp"

namespace verp::model {

/// What one tick's frames take of a robot's bus, whichever protocol it speaks.
struct BusTime {
  double us = 0;          ///< on the wire, at worst
  double share = 0;       ///< of the control period
  std::size_t bytes = 0;  ///< serial; on CAN 0
  std::size_t bits = 0;   ///< with worst stuffing; serial: 10 a byte
};
BusTime bus_time(const Params& params);

}  // namespace verp::model
