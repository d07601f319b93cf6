#include "hal/chip/stm32/watchdog.hpp"
#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/iwdg_model.hpp"

// hal/contract/tick_source.hpp and watchdog.hpp.
namespace verp::hal::stm32::test {
namespace {

class TickTimerDriver : public EachFamily {
 protected:
  Rig rig{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(, TickTimerDriver, kFamilies, name_of);

TEST_P(TickTimerDriver, CountsMicrosecondsOfRealTime) {
  const std::uint64_t before_us = rig.timer.now_us();
  rig.machine.advance(ms(50));
  EXPECT_NEAR(static_cast<double>(rig.timer.now_us() - before_us), 50'000, 2);
}

TEST_P(TickTimerDriver, WakesOnTimeAndNeverEarly) {
  EXPECT_EQ(rig.timer.wait(), 0u);
  EXPECT_FALSE(rig.timer.start(0));
  const std::uint64_t begin_us = rig.timer.now_us();
  ASSERT_TRUE(rig.timer.start(1537));
  for (std::uint64_t tick = 1; tick <= 20; ++tick) {
    EXPECT_EQ(rig.timer.wait(), 1u);
    const std::uint64_t late_us = rig.timer.now_us() - begin_us - tick * 1537;
    EXPECT_LE(late_us, 10u) << tick;
  }
}

TEST_P(TickTimerDriver, CountsWhatTheLoopMissed) {
  ASSERT_TRUE(rig.timer.start(1000));
  EXPECT_EQ(rig.timer.wait(), 1u);
  rig.machine.advance(us(3500));
  EXPECT_EQ(rig.timer.wait(), 3u);
  EXPECT_EQ(rig.timer.wait(), 1u);
}

TEST(TickTimerWithoutClock, IsRefusedAsItDoesNotCount) {
  Machine machine(Family::kF405);
  Timer timer(base::kTim2, machine.io());
  EXPECT_FALSE(timer.open(16'000'000, 16'000'000));
  EXPECT_FALSE(timer.open(1'500'000, 16'000'000)) << "no whole microseconds";
}

class WatchdogDriver : public EachFamily {
 protected:
  Rig rig{GetParam()};
  IndependentWatchdog<Io> dog{ResetCause::kPowerOn, rig.machine.io()};
};
INSTANTIATE_TEST_SUITE_P(, WatchdogDriver, kFamilies, name_of);

// Late by at most the contract's slack, over the oscillator's range.
TEST_P(WatchdogDriver, BitesNeitherEarlyNorTooLateOnAnyChip) {
  for (const std::uint32_t lsi_hz : {17'000u, 32'000u, 47'000u}) {
    for (const std::uint32_t timeout_us : {2'000u, 20'000u, 100'000u, 700'000u, 10'000'000u}) {
      Machine machine(GetParam());
      machine.iwdg().lsi_hz = lsi_hz;
      IndependentWatchdog<Io> one(ResetCause::kPowerOn, machine.io());
      ASSERT_TRUE(one.start(timeout_us)) << timeout_us;
      one.feed();
      const model::Time wait = machine.iwdg().bites_at() - machine.now();
      EXPECT_GE(wait + us(2), us(timeout_us)) << lsi_hz;
      EXPECT_LE(wait, us(std::uint64_t{kWatchdogSlack} * timeout_us)) << lsi_hz;
      EXPECT_EQ(machine.violations_text(), "");
    }
  }
}

TEST_P(WatchdogDriver, ResetsAnUnfedLoopOnly) {
  rig.machine.iwdg().lsi_hz = 47'000;
  ASSERT_TRUE(dog.start(20'000));
  for (int i = 0; i < 50; ++i) {
    rig.machine.advance(us(19'000));
    dog.feed();
  }
  EXPECT_EQ(rig.machine.resets(), 0u);
  rig.machine.advance(us(60'000));
  EXPECT_EQ(rig.machine.resets(), 1u);
  EXPECT_EQ(take_reset_cause(rig.machine.io()), ResetCause::kWatchdog);
}

TEST_P(WatchdogDriver, ArmsOnceAndOnlyForWhatItCanWait) {
  EXPECT_FALSE(dog.start(0));
  EXPECT_FALSE(dog.start(0xFFFFFFFF));
  EXPECT_FALSE(dog.start(100)) << "a count of its prescaler is longer";
  EXPECT_FALSE(rig.machine.iwdg().started());
  EXPECT_TRUE(dog.start(20'000));
  EXPECT_FALSE(dog.start(20'000));
}

TEST_P(WatchdogDriver, IsRefusedWithoutItsOscillator) {
  rig.machine.rcc().lsi_start = kNever;
  EXPECT_FALSE(dog.start(20'000));
  EXPECT_FALSE(rig.machine.iwdg().started());
}

TEST_P(WatchdogDriver, IsRefusedWhenItsRegistersStick) {
  rig.machine.iwdg().busy_stuck = true;
  EXPECT_FALSE(dog.start(20'000));
  EXPECT_FALSE(rig.machine.iwdg().started());
}

TEST_P(WatchdogDriver, MakesRoomForWhatTakesSeconds) {
  rig.machine.iwdg().lsi_hz = 47'000;
  ASSERT_TRUE(dog.start(20'000));
  dog.stretch();
  rig.machine.advance(ms(6000));
  dog.relax();
  EXPECT_EQ(rig.machine.resets(), 0u);
  rig.machine.advance(ms(60));
  EXPECT_EQ(rig.machine.resets(), 1u);
}

}  // namespace
}  // namespace verp::hal::stm32::test
