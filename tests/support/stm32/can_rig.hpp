#pragma once
#include "hal/chip/stm32/bxcan.hpp"
#include "tests/support/stm32/can_model.hpp"
#include "tests/support/stm32/rig.hpp"

namespace verp::hal::stm32::test {

using Can = BxCan<Io, Timer>;
inline constexpr BxCanTiming kBxCanTiming = bxcan_timing(kPlan, 1'000'000);

struct CanRig {
  explicit CanRig(Family family) : rig(family) {
    enable_clock(rig.machine.io(), rcc::kApb1enr, rcc::kApb1Can1);
    for (unsigned line = irq::kCan1Tx; line <= irq::kCan1Error; ++line) {
      rig.machine.attach(line, [this] { driver.on_interrupt(); });
      enable_interrupt(rig.machine.io(), line, 4);
    }
    EXPECT_TRUE(driver.open(rig.clocks, kBxCanTiming));
  }

  Rig rig;
  model::CanModel& can = rig.machine.can1();
  Can driver{base::kCan1, rig.timer, rig.machine.io()};
};

}  // namespace verp::hal::stm32::test
