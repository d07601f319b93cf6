#pragma once
#include <gtest/gtest.h>

#include "hal/chip/stm32/clock.hpp"
#include "hal/chip/stm32/clock_gate.hpp"
#include "hal/chip/stm32/interrupts.hpp"
#include "hal/chip/stm32/tick_timer.hpp"
#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/timer_model.hpp"

/// Clocks and timer run. At the end there must be no violation.
namespace verp::hal::stm32::test {

using model::kNever;
using model::Machine;
using model::ms;
using model::us;
using Io = model::ModelIo;
using Timer = TickTimer<Io>;

inline constexpr ClockPlan kPlan = {
    .crystal_hz = 8'000'000, .external = false, .vco_hz = 336'000'000, .sysclk_hz = 168'000'000};

struct Rig {
  explicit Rig(Family family) : machine(family) {
    clocks = ClockTree<Io>(family, kPlan, machine.io()).start();
    enable_clock(machine.io(), rcc::kApb1enr, rcc::kApb1Tim2);
    EXPECT_TRUE(timer.open(clocks.apb1_timer_hz, clocks.sysclk_hz));
    machine.attach(irq::kTim2, [this] { timer.on_timer(); });
    enable_interrupt(machine.io(), irq::kTim2, 12);
  }
  ~Rig() { EXPECT_STREQ(machine.violations_text().c_str(), ""); }

  Machine machine;
  Clocks clocks;
  Timer timer{base::kTim2, machine.io()};
};

}  // namespace verp::hal::stm32::test
