#include "firmware/app/drive_power.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::app {
namespace {

using safety::Mode;
using Step = DrivePower::Step;

constexpr Mode kEvery[] = {Mode::kRelaxed, Mode::kRising,  Mode::kStanding, Mode::kWalking,
                           Mode::kHolding, Mode::kSitting, Mode::kFallen,   Mode::kStopped};

TEST(DrivePower, GoesInTheThirdTickOfAStopInWhateverMode) {
  for (const Mode mode : kEvery) {
    DrivePower drive;
    for (int tick = 0; tick < 100; ++tick) {
      EXPECT_TRUE(drive.after_tick(false, mode) == Step::kOn);
    }
    EXPECT_TRUE(drive.after_tick(true, mode) == Step::kOn) << "first torque off is sent";
    EXPECT_TRUE(drive.after_tick(true, mode) == Step::kOn);
    EXPECT_TRUE(drive.after_tick(true, mode) == Step::kOff);
  }
}

TEST(DrivePower, ComesBackOnlyReleasedAndRelaxedAndThenWithANewBringUp) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    test::Random random(seed);
    DrivePower drive;
    for (int tick = 0; tick < DrivePower::kTorqueFirst; ++tick) {
      drive.after_tick(true, Mode::kStopped);
    }
    Step step = Step::kOff;
    for (int tick = 0; tick < 1000 && step != Step::kAnew; ++tick) {
      const bool pressed = random.below(2) == 0;
      const Mode mode = kEvery[random.below(8)];
      step = drive.after_tick(pressed, mode);
      EXPECT_TRUE(step == (!pressed && mode == Mode::kRelaxed ? Step::kAnew : Step::kOff));
    }
    EXPECT_TRUE(step == Step::kAnew);
  }
}

}  // namespace
}  // namespace verp::app
