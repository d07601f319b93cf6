#include <gtest/gtest.h>

#include "hal/chip/stm32/registers/cortex_m.hpp"
#include "hal/chip/stm32/registers/flash.hpp"
#include "hal/chip/stm32/registers/pwr.hpp"
#include "tests/host/stm32_model/chip.hpp"
#include "tests/support/stm32/flash_model.hpp"

namespace verp::hal::stm32::model {
namespace {

constexpr std::uint32_t kRccCr = base::kRcc + rcc::kCr;
constexpr std::uint32_t kRccCfgr = base::kRcc + rcc::kCfgr;

/// 168 MHz from 8 MHz: 8 / 8 * 336 / 2.
constexpr std::uint32_t kPll168 = 8u | 336u << rcc::kPllcfgrNShift | rcc::kPllcfgrSrcHse |
                                  7u << rcc::kPllcfgrQShift | 0x20000000u;

void start_hse(Machine& machine) {
  ModelIo io = machine.io();
  modify32(io, kRccCr, 0, rcc::kCrHseon);
}

TEST(Clock, StartsOnHsiAt16MHz) {
  for (const Family family : kFamilies) {
    Machine machine(family);
    EXPECT_EQ(machine.rcc().hclk_hz(), 16000000u);
    EXPECT_EQ(machine.rcc().apb1_hz(), 16000000u);
  }
}

TEST(Clock, HseComesAfterItsTimeOrNever) {
  Machine machine(Family::kF405);
  start_hse(machine);
  EXPECT_FALSE(wait_set(machine, kRccCr, rcc::kCrHserdy, ms(1)));
  EXPECT_TRUE(wait_set(machine, kRccCr, rcc::kCrHserdy, ms(2)));
  Machine silent(Family::kF405);
  silent.rcc().hse_start = kNever;
  start_hse(silent);
  EXPECT_FALSE(wait_set(silent, kRccCr, rcc::kCrHserdy, ms(20)));
  EXPECT_EQ(silent.violations_text(), "");
}

void run_at_168(Machine& machine, std::uint32_t wait_states) {
  ModelIo io = machine.io();
  start_hse(machine);
  ASSERT_TRUE(wait_set(machine, kRccCr, rcc::kCrHserdy, ms(5)));
  io.write32(base::kFlash + flash::kAcr, wait_states);
  io.write32(base::kRcc + rcc::kPllcfgr, kPll168);
  modify32(io, kRccCr, 0, rcc::kCrPllon);
  ASSERT_TRUE(wait_set(machine, kRccCr, rcc::kCrPllrdy, ms(5)));
  io.write32(kRccCfgr, rcc::kPpre4 << rcc::kCfgrPpre1Shift | rcc::kPpre2 << rcc::kCfgrPpre2Shift);
  modify32(io, kRccCfgr, rcc::kCfgrSw, rcc::kClockPll);
  ASSERT_TRUE(wait_set(machine, kRccCfgr, rcc::kClockPll << rcc::kCfgrSwsShift, ms(1)));
}

TEST(Clock, TheManualsWayTo168MHzIsAccepted) {
  Machine machine(Family::kF405);
  run_at_168(machine, 5);
  EXPECT_EQ(machine.violations_text(), "");
  EXPECT_EQ(machine.rcc().hclk_hz(), 168000000u);
  EXPECT_EQ(machine.rcc().apb1_hz(), 42000000u);
  EXPECT_EQ(machine.rcc().apb2_hz(), 84000000u);
  EXPECT_EQ(machine.rcc().timer_hz(base::kTim2), 84000000u);
  EXPECT_EQ(machine.rcc().timer_hz(base::kTim1), 168000000u);
}

TEST(Clock, TooFewWaitStatesAreSeen) {
  Machine machine(Family::kF405);
  run_at_168(machine, 4);
  EXPECT_TRUE(one_violation(machine, "4 wait states")) << machine.violations_text();
}

TEST(Clock, TooFastABusIsSeen) {
  Machine machine(Family::kF405);
  run_at_168(machine, 5);
  ModelIo io = machine.io();
  modify32(io, kRccCfgr, rcc::kCfgrPpre1, rcc::kPpre2 << rcc::kCfgrPpre1Shift);
  EXPECT_TRUE(one_violation(machine, "APB1 at 84000000")) << machine.violations_text();
}

TEST(Clock, SwitchingToAClockThatIsNotReadyIsSeenAndWaits) {
  Machine machine(Family::kF446);
  ModelIo io = machine.io();
  modify32(io, kRccCfgr, rcc::kCfgrSw, rcc::kClockHse);
  EXPECT_TRUE(one_violation(machine, "not ready")) << machine.violations_text();
  EXPECT_FALSE(wait_set(machine, kRccCfgr, rcc::kClockHse << rcc::kCfgrSwsShift, ms(5)));
  EXPECT_EQ(machine.rcc().hclk_hz(), 16000000u);
}

TEST(Clock, ThePllIsNotChangedWhileItRunsAndNotFedBeyondItsRange) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  io.write32(base::kRcc + rcc::kPllcfgr, 0x27003010u);  // HSI / 16 * 192
  modify32(io, kRccCr, 0, rcc::kCrPllon);
  EXPECT_EQ(machine.violations_text(), "");
  io.write32(base::kRcc + rcc::kPllcfgr, kPll168);
  EXPECT_TRUE(one_violation(machine, "PLL is on"));
  modify32(io, kRccCr, rcc::kCrPllon, 0);
  io.write32(base::kRcc + rcc::kPllcfgr, 0x27003004u);  // 4 MHz into the VCO
  modify32(io, kRccCr, 0, rcc::kCrPllon);
  EXPECT_FALSE(machine.violations().empty());
  EXPECT_NE(machine.violations_text().find("PLL input of 4000000"), std::string::npos);
}

TEST(Clock, TheOscillatorInUseCannotBeSwitchedOff) {
  Machine machine(Family::kF746);
  ModelIo io = machine.io();
  modify32(io, kRccCr, rcc::kCrHsion, 0);
  EXPECT_TRUE(one_violation(machine, "system clock"));
  EXPECT_NE(io.read32(kRccCr) & rcc::kCrHsion, 0u);
}

TEST(Clock, OverdriveComesInTwoStepsOrNever) {
  for (const bool stuck : {false, true}) {
    Machine machine(Family::kF746);
    machine.pwr().overdrive_stuck = stuck;
    ModelIo io = machine.io();
    enable(io, rcc::kApb1enr, rcc::kApb1Pwr);
    const std::uint32_t cr = base::kPwr + pwr::kCr, csr = base::kPwr + pwr::kCsr;
    modify32(io, cr, 0, pwr::kCrOden);
    EXPECT_EQ(wait_set(machine, csr, pwr::kCsrOdrdy, ms(1)), !stuck);
    if (stuck) continue;
    EXPECT_EQ(machine.pwr().hclk_max_hz(), 180000000u);
    modify32(io, cr, 0, pwr::kCrOdswen);
    EXPECT_TRUE(wait_set(machine, csr, pwr::kCsrOdswrdy, ms(1)));
    EXPECT_EQ(machine.pwr().hclk_max_hz(), 216000000u);
    EXPECT_EQ(machine.violations_text(), "");
  }
}

TEST(Reset, CausesAreToldUntilTheyAreCleared) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  const std::uint32_t csr = base::kRcc + rcc::kCsr;
  EXPECT_NE(io.read32(csr) & rcc::kCsrPorrstf, 0u);
  modify32(io, csr, 0, rcc::kCsrRmvf);
  EXPECT_EQ(io.read32(csr) & bits(25, 7), 0u);
  io.write32(cortex_m::kAircr, cortex_m::kAircrKey | cortex_m::kAircrSysresetreq);
  EXPECT_EQ(machine.resets(), 1u);
  EXPECT_EQ(io.read32(csr) & bits(25, 7), rcc::kCsrSftrstf | rcc::kCsrPinrstf);
  io.write32(cortex_m::kAircr, cortex_m::kAircrSysresetreq);
  EXPECT_TRUE(one_violation(machine, "wrong key"));
}

}  // namespace
}  // namespace verp::hal::stm32::model
