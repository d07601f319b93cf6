#pragma once
#include <cstdint>

namespace verp::app {

/// What went wrong on the bus since power-up, whichever protocol it carries.
struct BusCounters {
  std::uint32_t refused = 0;   ///< frames the backend did not take
  std::uint32_t timeouts = 0;  ///< requests that some device did not answer in time
  std::uint32_t strays = 0;    ///< good packets nobody had asked for
  std::uint32_t errors = 0;    ///< answers that tell of an error: status packets, SDO aborts, EMCY
};

}  // namespace verp::app
