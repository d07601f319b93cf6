#pragma once
#include <cstdint>

#include "common/base/can_timing.hpp"
#include "hal/chip/stm32/clock.hpp"
#include "hal/chip/stm32/registers/can.hpp"

namespace verp::hal::stm32 {

/// CanTiming with a `prescaler` of 1 to 1024.
struct BxCanTiming : CanTiming {
  std::uint32_t clock_hz = 0;  ///< APB1 clock that it applies to; 0: none found
  std::uint32_t bitrate = 0;

  constexpr std::uint32_t btr() const {
    return (prescaler - 1) | (before - 1) << can::kBtrTs1Shift | (after - 1) << can::kBtrTs2Shift |
           (jump - 1) << can::kBtrSjwShift;
  }
};

/// False: no sample point within 85 to 90 % of a bit, as CiA 301 requires.
constexpr bool choose_bxcan_timing(std::uint32_t clock_hz, std::uint32_t bitrate,
                                   BxCanTiming& timing) {
  timing = {can_timing(clock_hz, bitrate, 1024, {.least = 850}), clock_hz, bitrate};
  if (!timing.possible()) timing = {};
  return timing.possible();
}

/// Never defined: a call in a constant expression is the compile error.
void no_such_bxcan_timing();

/// A clock plan without a timing does not compile: `constexpr BxCanTiming kTiming =
/// bxcan_timing(kClockPlan, 1'000'000);`
consteval BxCanTiming bxcan_timing(const ClockPlan& plan, std::uint32_t bitrate) {
  BxCanTiming timing;
  if (plan.crystal_hz == 0 || !choose_bxcan_timing(plan.sysclk_hz / 4, bitrate, timing)) {
    no_such_bxcan_timing();
  }
  return timing;
}
}  // namespace verp::hal::stm32
