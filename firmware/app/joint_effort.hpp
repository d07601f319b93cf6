#pragma once
#include <cstdint>

namespace verp::app {

/// How a joint moves and pushes, as its drive told last (CiA 402); zeros until it has. Nothing of
/// it enters the core.
struct JointEffort {
  std::int32_t velocity = 0;  ///< 606Ch, counts per second
  std::int16_t torque = 0;    ///< 6077h, thousandths of the rated torque

  constexpr bool operator==(const JointEffort&) const = default;
};

}  // namespace verp::app
