#pragma once
#include <cstdint>

namespace verp::app {

/// As the joint's drive last reported (CiA 402); zero until then. The core does not use it.
struct JointEffort {
  std::int32_t velocity = 0;  ///< 606Ch, counts per second
  std::int16_t torque = 0;    ///< 6077h, thousandths of the rated torque

  constexpr bool operator==(const JointEffort&) const = default;
};

}  // namespace verp::app
