#pragma once
#include <cstdint>

#include "boards/stm32/hardware.hpp"
#include "firmware/app/start_fault.hpp"

namespace verp::board {

/// The timer does not count: the LED blinks the fault, timed roughly by instructions.
[[noreturn]] inline void refuse_without_time(const Start& start) {
  constexpr std::uint32_t kStep_us = 1000, kCycles = 8;  // of one round
  constexpr std::uint32_t kSlowest_hz = 16'000'000;      // internal oscillator
  const std::uint32_t core_hz = start.clocks.sysclk_hz != 0 ? start.clocks.sysclk_hz : kSlowest_hz;
  const std::uint32_t rounds = core_hz / 1'000'000 * kStep_us / kCycles;
  stm32::Gpio<Io> gpio;
  app::LifeSign life;
  for (std::uint64_t now_us = 0;; now_us += kStep_us) {
    const app::LifeSign::Now sign = life.at(now_us, app::table::StartFault::kTimer);
    if (sign.changed) gpio.write(kLed, sign.lit);
    for (std::uint32_t round = 0; round < rounds; ++round) Io{}.barrier();
  }
}

}  // namespace verp::board
