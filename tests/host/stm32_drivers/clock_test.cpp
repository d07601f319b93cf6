#include "hal/chip/stm32/instruction_cache.hpp"
#include "hal/chip/stm32/reset_cause.hpp"
#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/core_model.hpp"

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

// Reading clears the flags.
TEST_P(Clock, TellsWhyTheChipStarted) {
  machine.reset(model::ResetCause::kIwdg);
  EXPECT_EQ(take_reset_cause(machine.io()), ResetCause::kWatchdog);
  machine.reset(model::ResetCause::kSoftware);
  EXPECT_EQ(take_reset_cause(machine.io()), ResetCause::kSoftware);
  machine.reset(model::ResetCause::kPin);
  EXPECT_EQ(take_reset_cause(machine.io()), ResetCause::kPin);
  EXPECT_EQ(machine.violations_text(), "");
}

// With overdrive, on OpenCR's crystal.
struct Fast {
  Family family;
  ClockPlan plan;
};
class Overdrive : public ::testing::TestWithParam<Fast> {
 protected:
  Clocks start() { return ClockTree<Io>(GetParam().family, GetParam().plan, machine.io()).start(); }
  Machine machine{GetParam().family, {.hse_hz = 25'000'000}};
};
constexpr ClockPlan fast_plan(std::uint32_t sysclk_hz) {
  return {.crystal_hz = 25'000'000, .vco_hz = 2 * sysclk_hz, .sysclk_hz = sysclk_hz};
}
INSTANTIATE_TEST_SUITE_P(, Overdrive,
                         ::testing::Values(Fast{Family::kF446, fast_plan(180'000'000)},
                                           Fast{Family::kF746, fast_plan(216'000'000)}),
                         [](const ::testing::TestParamInfo<Fast>& fast) {
                           return fast.param.family == Family::kF446 ? "F446" : "F746";
                         });
static_assert(is_possible(fast_plan(216'000'000), Family::kF746));
static_assert(!is_possible(fast_plan(180'000'000), Family::kF405), "it has no overdrive");

TEST_P(Overdrive, ReachesTheSpeedThatNeedsIt) {
  const Clocks clocks = start();
  EXPECT_EQ(clocks.source, ClockSource::kCrystal);
  EXPECT_EQ(machine.rcc().hclk_hz(), GetParam().plan.sysclk_hz);
  EXPECT_EQ(machine.rcc().apb1_hz(), clocks.apb1_hz);
  EXPECT_EQ(machine.rcc().timer_hz(base::kTim2), clocks.apb1_timer_hz);
  EXPECT_EQ(machine.violations_text(), "");
}

TEST_P(Overdrive, CrystalThatNeverStartsCostsNoSpeed) {
  machine.rcc().hse_start = kNever;
  EXPECT_EQ(start().source, ClockSource::kInternalPll);
  EXPECT_EQ(machine.rcc().hclk_hz(), GetParam().plan.sysclk_hz);
  EXPECT_EQ(machine.violations_text(), "");
}

TEST_P(Overdrive, ThatNeverComesLeavesSixteenMegahertzInTime) {
  machine.pwr().overdrive_stuck = true;
  const Clocks clocks = start();
  EXPECT_EQ(clocks.source, ClockSource::kInternal);
  EXPECT_EQ(machine.rcc().hclk_hz(), kHsi_hz);
  EXPECT_EQ(machine.violations_text(), "");
  EXPECT_LT(machine.now(), ms(500));
}

// Stale instructions would run.
TEST(InstructionCache, IsEmptiedBeforeItIsSwitchedOn) {
  Machine machine(Family::kF746);
  machine.io().write32(cortex_m::kIciallu, 1);
  enable_instruction_cache(machine.io());
  EXPECT_EQ(machine.io().read32(cortex_m::kIciallu), 0u);
  EXPECT_EQ(machine.io().read32(cortex_m::kCcr) & (cortex_m::kCcrIc | cortex_m::kCcrDc),
            cortex_m::kCcrIc);
}

}  // namespace
}  // namespace verp::hal::stm32::test
