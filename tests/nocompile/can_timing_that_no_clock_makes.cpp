// must say: no_such_bxcan_timing
#include "hal/chip/stm32/bxcan_timing.hpp"

namespace {

using namespace verp::hal::stm32;

/// Compilation fails, not the robot.
#ifndef BROKEN
constexpr std::uint32_t kRate = 1'000'000;
#else
constexpr std::uint32_t kRate = 800'000;
#endif
constexpr ClockPlan kPlan = {
    .crystal_hz = 8'000'000, .external = false, .vco_hz = 336'000'000, .sysclk_hz = 168'000'000};
constexpr BxCanTiming kTiming = bxcan_timing(kPlan, kRate);
static_assert(kTiming.btr() != 0);

}  // namespace
