#include <gtest/gtest.h>

#include "hal/chip/stm32/registers/cortex_m.hpp"
#include "hal/chip/stm32/registers/iwdg.hpp"
#include "hal/chip/stm32/registers/timer.hpp"
#include "hal/chip/stm32/registers/usart.hpp"
#include "tests/host/stm32_model/chip.hpp"
#include "tests/support/stm32/gpio_model.hpp"
#include "tests/support/stm32/registers/gpio_table.hpp"
#include "tests/support/stm32/timer_model.hpp"

namespace verp::hal::stm32::model {
namespace {

TEST(Bus, RegistersHoldTheirResetValues) {
  for (const Family family : kFamilies) {
    Machine machine(family);
    for (const auto& bank : machine.banks()) bank->reset();
    const Table& table = rcc::table(family);
    for (const Register& reg : table)
      EXPECT_EQ(machine.rcc().peek(reg.offset), reg.reset) << reg.name;
    EXPECT_EQ(machine.gpio('A').peek(gpio::kModer), gpio::kModerResetA);
    EXPECT_EQ(machine.gpio('C').peek(gpio::kModer), 0u);
  }
}

TEST(Bus, NothingWorksWithoutItsClock) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  io.write32(base::kTim2 + timer::kArr, 99);
  EXPECT_TRUE(one_violation(machine, "clock is off")) << machine.violations_text();
  EXPECT_EQ(machine.tim(2).peek(timer::kArr), 0xFFFFFFFFu);
  EXPECT_EQ(io.read32(base::kTim2 + timer::kArr), 0u);
  EXPECT_TRUE(one_violation(machine, "clock is off"));
}

TEST(Bus, AnAccessRightAfterTheClockIsSwitchedOnIsTooSoon) {
  Machine machine(Family::kF746);
  ModelIo io = machine.io();
  modify32(io, base::kRcc + rcc::kApb1enr, 0, rcc::kApb1Tim2);
  io.write32(base::kTim2 + timer::kPsc, 1);
  EXPECT_TRUE(one_violation(machine, "read RCC back")) << machine.violations_text();
  enable(io, rcc::kApb1enr, rcc::kApb1Tim5);
  io.write32(base::kTim5 + timer::kPsc, 1);
  modify32(io, base::kRcc + rcc::kApb1enr, 0, rcc::kApb1Tim3);
  io.barrier();
  io.write32(base::kTim3 + timer::kPsc, 1);
  EXPECT_EQ(machine.violations_text(), "");
}

TEST(Bus, ReservedAndReadOnlyBitsAreWatched) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  enable(io, rcc::kApb1enr, rcc::kApb1Tim2 | rcc::kApb1Usart2);
  io.write32(base::kTim2 + timer::kSr, ~timer::kSrUif);
  EXPECT_TRUE(one_violation(machine, "reserved")) << machine.violations_text();
  io.write32(base::kTim2 + timer::kSr, timer::kSrAll & ~timer::kSrUif);
  EXPECT_EQ(machine.violations_text(), "");
  io.write32(base::kRcc + rcc::kCr, io.read32(base::kRcc + rcc::kCr) | rcc::kCrHserdy);
  EXPECT_TRUE(one_violation(machine, "read-only")) << machine.violations_text();
  io.write32(base::kIwdg + iwdg::kSr, 0);
  EXPECT_TRUE(one_violation(machine, "only be read")) << machine.violations_text();
  io.read32(base::kIwdg + iwdg::kKr);
  EXPECT_TRUE(one_violation(machine, "only be written"));
  io.write32(base::kIwdg + 0x20, 0);
  EXPECT_TRUE(one_violation(machine, "nothing")) << machine.violations_text();
  io.write16(base::kTim2 + timer::kArr, 1);
  EXPECT_TRUE(one_violation(machine, "16 bits"));
}

TEST(Bus, AReadAndWriteBackIsNoViolationThoughHardwareMovedBetween) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  modify32(io, base::kRcc + rcc::kCr, 0, rcc::kCrHseon);
  const std::uint32_t before = io.read32(base::kRcc + rcc::kCr);
  machine.advance(ms(10));
  io.write32(base::kRcc + rcc::kCr, before);
  EXPECT_EQ(machine.violations_text(), "");
  EXPECT_NE(io.read32(base::kRcc + rcc::kCr) & rcc::kCrHserdy, 0u);
}

TEST(Bus, TimePassesWithEachAccess) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  const Time before = machine.now();
  for (int i = 0; i < 16; ++i) io.read32(base::kRcc + rcc::kCr);
  EXPECT_EQ(machine.now() - before, us(10));  // 16 accesses of 10 cycles at 16 MHz
  EXPECT_EQ(machine.core_cycles(), 160u);
}

TEST(Core, CycleCounterCountsOnceItIsSwitchedOn) {
  Machine machine(Family::kF746);
  ModelIo io = machine.io();
  EXPECT_EQ(io.read32(cortex_m::kDwtCyccnt), 0u);
  io.write32(cortex_m::kDemcr, cortex_m::kDemcrTrcena);
  io.write32(cortex_m::kDwtCyccnt, 0);
  io.write32(cortex_m::kDwtCtrl, cortex_m::kDwtCtrlCyccntena);
  machine.advance(ms(1));
  EXPECT_NEAR(static_cast<double>(io.read32(cortex_m::kDwtCyccnt)), 16000, 40);
}

TEST(Core, SysTickWrapsAndSaysSoOnce) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  io.write32(cortex_m::kSystRvr, 15999);
  io.write32(cortex_m::kSystCvr, 0);
  io.write32(cortex_m::kSystCsr, cortex_m::kSystCsrEnable | cortex_m::kSystCsrCore);
  EXPECT_EQ(io.read32(cortex_m::kSystCsr) & cortex_m::kSystCsrCountflag, 0u);
  machine.advance(ms(1));
  EXPECT_NE(io.read32(cortex_m::kSystCsr) & cortex_m::kSystCsrCountflag, 0u);
  EXPECT_EQ(io.read32(cortex_m::kSystCsr) & cortex_m::kSystCsrCountflag, 0u);
}

TEST(Core, InterruptsComeOnlyWhenEnabledAndUnmasked) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  int calls = 0;
  machine.attach(irq::kTim2, [&] {
    ++calls;
    io.write32(base::kTim2 + timer::kSr, timer::kSrAll & ~timer::kSrUif);
  });
  enable(io, rcc::kApb1enr, rcc::kApb1Tim2);
  io.write32(base::kTim2 + timer::kArr, 15999);
  io.write32(base::kTim2 + timer::kDier, timer::kDierUie);
  io.write32(base::kTim2 + timer::kCr1, timer::kCr1Cen);
  machine.advance(us(1500));
  EXPECT_EQ(calls, 0);
  io.write32(cortex_m::kNvicIser, 1u << irq::kTim2);
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(io.mask_interrupts());
  EXPECT_FALSE(io.mask_interrupts());
  machine.advance(ms(3));
  EXPECT_EQ(calls, 1);
  io.unmask_interrupts();
  EXPECT_EQ(calls, 2);
  machine.advance(ms(3));
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(machine.violations_text(), "");
}

TEST(Core, AHandlerThatDoesNotClearItsCauseIsAStorm) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  machine.attach(irq::kTim2, [] {});
  enable(io, rcc::kApb1enr, rcc::kApb1Tim2);
  io.write32(cortex_m::kNvicIser, 1u << irq::kTim2);
  io.write32(base::kTim2 + timer::kDier, timer::kDierUie);
  io.write32(base::kTim2 + timer::kEgr, timer::kEgrUg);
  EXPECT_FALSE(machine.violations().empty());
  EXPECT_NE(machine.violations_text().find("storm"), std::string::npos);
}

TEST(Gpio, SetAndResetDriveThePinAndInputsReadTheOutside) {
  Machine machine(Family::kF446);
  ModelIo io = machine.io();
  enable(io, rcc::kAhb1enr, rcc::kAhb1GpioA << 2);
  const std::uint32_t port = base::gpio('C');
  io.write32(port + gpio::kModer, gpio::kModeOutput << 10);
  io.write32(port + gpio::kBsrr, 1u << 5);
  EXPECT_TRUE(machine.gpio('C').level(5));
  io.write32(port + gpio::kBsrr, 1u << 21);
  EXPECT_FALSE(machine.gpio('C').level(5));
  machine.gpio('C').drive(7, GpioModel::Outside::kHigh);
  EXPECT_EQ(io.read32(port + gpio::kIdr), 1u << 7);
  io.write32(port + gpio::kPupdr, gpio::kPullUp << 18);
  EXPECT_EQ(io.read32(port + gpio::kIdr), 1u << 7 | 1u << 9);
  EXPECT_EQ(machine.violations_text(), "");
}

}  // namespace
}  // namespace verp::hal::stm32::model
