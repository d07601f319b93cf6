#include <gtest/gtest.h>

#include "hal/chip/stm32/registers/adc.hpp"
#include "hal/chip/stm32/registers/iwdg.hpp"
#include "hal/chip/stm32/registers/timer.hpp"
#include "tests/host/stm32_model/chip.hpp"
#include "tests/support/stm32/adc_model.hpp"
#include "tests/support/stm32/iwdg_model.hpp"
#include "tests/support/stm32/timer_model.hpp"

namespace verp::hal::stm32::model {
namespace {

TEST(Timer, CountsAtItsClockThroughItsPrescalerOnceUpdated) {
  for (const Family family : kFamilies) {
    Machine machine(family);
    ModelIo io = machine.io();
    enable(io, rcc::kApb1enr, rcc::kApb1Tim2);
    io.write32(base::kTim2 + timer::kPsc, 15);
    io.write32(base::kTim2 + timer::kCr1, timer::kCr1Cen);
    machine.advance(us(100));
    EXPECT_GT(io.read32(base::kTim2 + timer::kCnt), 1600u);  // the prescaler waits for an update
    io.write32(base::kTim2 + timer::kEgr, timer::kEgrUg);
    machine.advance(us(100));
    EXPECT_NEAR(static_cast<double>(io.read32(base::kTim2 + timer::kCnt)), 100, 2);
    EXPECT_EQ(machine.violations_text(), "");
  }
}

TEST(Timer, OverflowsWithoutDriftAndFlagsEachTime) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  enable(io, rcc::kApb1enr, rcc::kApb1Tim5);
  io.write32(base::kTim5 + timer::kArr, 127999);  // 8 ms
  io.write32(base::kTim5 + timer::kCr1, timer::kCr1Cen);
  machine.advance(ms(8 * 125) + us(1));
  EXPECT_EQ(machine.tim(5).updates(), 125u);
  EXPECT_NE(io.read32(base::kTim5 + timer::kSr) & timer::kSrUif, 0u);
  io.write32(base::kTim5 + timer::kSr, timer::kSrAll & ~timer::kSrUif);
  EXPECT_EQ(io.read32(base::kTim5 + timer::kSr) & timer::kSrUif, 0u);
  EXPECT_LT(io.read32(base::kTim5 + timer::kCnt), 100u);
}

TEST(Timer, CompareFlagsComeAtTheirCount) {
  Machine machine(Family::kF746);
  ModelIo io = machine.io();
  enable(io, rcc::kApb1enr, rcc::kApb1Tim2);
  io.write32(base::kTim2 + timer::kCcr1, 16000);
  io.write32(base::kTim2 + timer::kCr1, timer::kCr1Cen);
  machine.advance(us(990));
  EXPECT_EQ(io.read32(base::kTim2 + timer::kSr) & timer::kSrCc1if, 0u);
  machine.advance(us(20));
  EXPECT_NE(io.read32(base::kTim2 + timer::kSr) & timer::kSrCc1if, 0u);
}

TEST(Timer, AStoppedCounterKeepsItsCountAndAReloadWithPreloadWaits) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  enable(io, rcc::kApb1enr, rcc::kApb1Tim2);
  io.write32(base::kTim2 + timer::kArr, 15999);
  io.write32(base::kTim2 + timer::kEgr, timer::kEgrUg);
  io.write32(base::kTim2 + timer::kCr1, timer::kCr1Cen | timer::kCr1Arpe);
  io.write32(base::kTim2 + timer::kArr, 31999);
  machine.advance(us(1500));
  io.write32(base::kTim2 + timer::kCr1, timer::kCr1Arpe);
  const std::uint32_t held = io.read32(base::kTim2 + timer::kCnt);
  EXPECT_NEAR(held, 8000, 100);  // the first period kept the old end
  machine.advance(ms(5));
  EXPECT_EQ(io.read32(base::kTim2 + timer::kCnt), held);
}

/// From PR and RLR, never fed.
Time bite_time(Machine& machine, std::uint32_t pr, std::uint32_t rlr) {
  ModelIo io = machine.io();
  Time bitten = 0;
  machine.on_reset([&](ResetCause cause) {
    if (cause == ResetCause::kIwdg && bitten == 0) bitten = machine.now();
  });
  io.write32(base::kIwdg + iwdg::kKr, iwdg::kKeyStart);
  io.write32(base::kIwdg + iwdg::kKr, iwdg::kKeyUnlock);
  io.write32(base::kIwdg + iwdg::kPr, pr);
  io.write32(base::kIwdg + iwdg::kRlr, rlr);
  machine.advance(ms(2));
  io.write32(base::kIwdg + iwdg::kKr, iwdg::kKeyReload);
  const Time fed = machine.now();
  machine.advance(40 * kSecond);
  return bitten == 0 ? 0 : bitten - fed;
}

TEST(Iwdg, BitesAfterItsTimeByItsOwnClock) {
  for (const std::uint32_t lsi : {17000u, 32000u, 47000u}) {
    for (const Family family : kFamilies) {
      Machine machine(family);
      machine.iwdg().lsi_hz = lsi;
      const Time want = duration(std::uint64_t{16} * 500, lsi);
      EXPECT_NEAR(static_cast<double>(bite_time(machine, 2, 499)), static_cast<double>(want), 1e9);
      EXPECT_NE(machine.rcc().peek(rcc::kCsr) & rcc::kCsrIwdgrstf, 0u);
      EXPECT_FALSE(machine.iwdg().started());
      EXPECT_EQ(machine.violations_text(), "");
    }
  }
}

TEST(Iwdg, FedInTimeItNeverBites) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  io.write32(base::kIwdg + iwdg::kKr, iwdg::kKeyStart);  // 512 ms at 32 kHz
  for (int i = 0; i < 100; ++i) {
    machine.advance(ms(500));
    io.write32(base::kIwdg + iwdg::kKr, iwdg::kKeyReload);
  }
  EXPECT_EQ(machine.resets(), 0u);
  machine.advance(ms(520));
  EXPECT_EQ(machine.resets(), 1u);
}

TEST(Iwdg, SettingsNeedTheKeyAndTheirTime) {
  Machine machine(Family::kF446);
  ModelIo io = machine.io();
  io.write32(base::kIwdg + iwdg::kPr, 3);
  EXPECT_TRUE(one_violation(machine, "without the key"));
  io.write32(base::kIwdg + iwdg::kKr, iwdg::kKeyUnlock);
  io.write32(base::kIwdg + iwdg::kPr, 3);
  EXPECT_NE(io.read32(base::kIwdg + iwdg::kSr) & iwdg::kSrPvu, 0u);
  io.write32(base::kIwdg + iwdg::kPr, 4);
  EXPECT_TRUE(one_violation(machine, "PVU"));
  EXPECT_TRUE(wait_clear(machine, base::kIwdg + iwdg::kSr, iwdg::kSrPvu, ms(2)));
  machine.iwdg().busy_stuck = true;
  EXPECT_FALSE(wait_clear(machine, base::kIwdg + iwdg::kSr, iwdg::kSrRvu, ms(20)));
  io.write32(base::kIwdg + iwdg::kKr, 0x1234);
  EXPECT_TRUE(one_violation(machine, "unknown key"));
}

TEST(Adc, ConvertsTheChannelThatWasAskedForOrNever) {
  for (const bool stuck : {false, true}) {
    Machine machine(Family::kF746);
    ModelIo io = machine.io();
    enable(io, rcc::kApb2enr, rcc::kApb2Adc1);
    machine.adc(1).input[9] = 2345;
    machine.adc(1).conversion_stuck = stuck;
    io.write32(base::kAdc1 + adc::kSqr3, 9);
    io.write32(base::kAdc1 + adc::kCr2, adc::kCr2Adon);
    machine.advance(us(5));
    io.write32(base::kAdc1 + adc::kCr2, adc::kCr2Adon | adc::kCr2Swstart);
    EXPECT_EQ(wait_set(machine, base::kAdc1 + adc::kSr, adc::kSrEoc, us(50)), !stuck);
    EXPECT_EQ(io.read32(base::kAdc1 + adc::kDr), stuck ? 0u : 2345u);
    EXPECT_EQ(machine.violations_text(), "");
  }
}

}  // namespace
}  // namespace verp::hal::stm32::model
