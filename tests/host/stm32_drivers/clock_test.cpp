#include "tests/host/stm32_drivers/rig.hpp"

#include "hal/chip/stm32/reset_cause.hpp"

// The clock tree: full speed where there is a crystal, the next best where not, and always an end.
namespace verp::hal::stm32::test {
namespace {

class Clock : public EachFamily {
 protected:
  Clocks start() { return ClockTree<Io>(GetParam(), kPlan, machine.io()).start(); }
  void expect_real(const Clocks& clocks) {
    EXPECT_EQ(machine.rcc().sysclk_hz(), clocks.sysclk_hz);
    EXPECT_EQ(machine.rcc().apb1_hz(), clocks.apb1_hz);
    EXPECT_EQ(machine.rcc().apb2_hz(), clocks.apb2_hz);
    EXPECT_EQ(machine.rcc().timer_hz(base::kTim2), clocks.apb1_timer_hz);
    EXPECT_EQ(machine.violations_text(), "");
  }
  Machine machine{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(, Clock, kFamilies, name_of);

TEST_P(Clock, RunsOnTheCrystalAtFullSpeed) {
  const Clocks clocks = start();
  EXPECT_EQ(clocks.source, ClockSource::kCrystal);
  EXPECT_EQ(clocks.sysclk_hz, 168'000'000u);
  EXPECT_TRUE(clocks.good_enough_for_can());
  expect_real(clocks);
}

TEST_P(Clock, CrystalThatNeverStartsLeavesTheInternalOscillator) {
  machine.rcc().hse_start = kNever;
  const Clocks clocks = start();
  EXPECT_EQ(clocks.source, ClockSource::kInternalPll);
  EXPECT_EQ(clocks.sysclk_hz, 168'000'000u);
  EXPECT_FALSE(clocks.good_enough_for_can());
  expect_real(clocks);
  EXPECT_LT(machine.now(), ms(500)) << "a robot waits for its controller";
}

TEST_P(Clock, SlowCrystalIsWaitedFor) {
  machine.rcc().hse_start = ms(20);
  EXPECT_EQ(start().source, ClockSource::kCrystal);
}

TEST_P(Clock, PllThatNeverLocksLeavesSixteenMegahertz) {
  machine.rcc().pll_lock = kNever;
  const Clocks clocks = start();
  EXPECT_EQ(clocks.source, ClockSource::kInternal);
  EXPECT_EQ(clocks.sysclk_hz, kHsi_hz);
  EXPECT_FALSE(clocks.good_enough_for_can());
  expect_real(clocks);
}

TEST_P(Clock, SwitchThatSticksLeavesSixteenMegahertz) {
  machine.rcc().sws_stuck = true;
  const Clocks clocks = start();
  EXPECT_EQ(clocks.source, ClockSource::kInternal);
  expect_real(clocks);
}

// The cause is that of this start only: the flags of the one before are gone.
TEST_P(Clock, TellsWhyTheChipStarted) {
  machine.reset(model::ResetCause::kIwdg);
  EXPECT_EQ(take_reset_cause(machine.io()), ResetCause::kWatchdog);
  machine.reset(model::ResetCause::kSoftware);
  EXPECT_EQ(take_reset_cause(machine.io()), ResetCause::kSoftware);
  machine.reset(model::ResetCause::kPin);
  EXPECT_EQ(take_reset_cause(machine.io()), ResetCause::kPin);
  EXPECT_EQ(machine.violations_text(), "");
}

}  // namespace
}  // namespace verp::hal::stm32::test
