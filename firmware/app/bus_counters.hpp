#pragma once
#include <cstdint>

namespace verp::app {

/// Since power-up, for every protocol.
struct BusCounters {
  std::uint32_t refused = 0;   ///< frames that the backend refused
  std::uint32_t timeouts = 0;  ///< requests that a device did not answer in time
  std::uint32_t strays = 0;    ///< valid packets without a request, and our own, echoed
  std::uint32_t errors = 0;    ///< error answers: status packets, SDO aborts, EMCY
};

}  // namespace verp::app
