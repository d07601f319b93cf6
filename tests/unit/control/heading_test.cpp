#include <gtest/gtest.h>

#include "tests/unit/control/loop.hpp"

/// What a walk does about its heading, through step().
namespace verp::control {
namespace {

using test::fresh_loop;
using test::Loop;

Loop& walking() {
  Loop& loop = fresh_loop();
  loop.tick();
  loop.walk(0);
  EXPECT_GE(loop.until(safety::Mode::kWalking, 1000), 0);
  return loop;
}

// A robot held by hand while it is told to turn: once it is let go it turns back what it is short
// of, not what it was held for.
TEST(Heading, AnOrderThatStepsCannotFollowIsNoSlip) {
  Loop& loop = walking();
  loop.command.wz_mrad_s = 1500;
  loop.ticks(1000);
  EXPECT_LT(math::abs(loop.state.steer.slip_rad), 0.05F);
}

// A slip repeated in every step is summed: 0.02 rad/s to the right for ten seconds.
TEST(Heading, ASlipThatGoesOnIsSummed) {
  Loop& loop = walking();
  loop.inputs.gyro_count[2] = -19;
  loop.ticks(1000);
  EXPECT_GT(loop.state.steer.slip_rad, 0.1F);
}

}  // namespace
}  // namespace verp::control
