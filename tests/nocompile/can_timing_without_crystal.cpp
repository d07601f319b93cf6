// must say: no_such_bxcan_timing
#include "hal/chip/stm32/bxcan_timing.hpp"

namespace {

using namespace verp::hal::stm32;

/// The internal oscillator is too inaccurate for CAN.
#ifndef BROKEN
constexpr std::uint32_t kCrystal_hz = 8'000'000;
#else
constexpr std::uint32_t kCrystal_hz = 0;
#endif
constexpr ClockPlan kPlan = {
    .crystal_hz = kCrystal_hz, .external = false, .vco_hz = 336'000'000, .sysclk_hz = 168'000'000};
constexpr BxCanTiming kTiming = bxcan_timing(kPlan, 1'000'000);
static_assert(kTiming.btr() != 0);

}  // namespace
