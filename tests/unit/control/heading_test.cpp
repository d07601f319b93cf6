#include <gtest/gtest.h>

#include "tests/unit/control/loop.hpp"

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

// Held by hand, the robot later turns back only the slip.
TEST(Heading, AnOrderThatStepsCannotFollowIsNoSlip) {
  Loop& loop = walking();
  loop.command.wz_mrad_s = 1500;
  loop.ticks(1000);
  EXPECT_LT(math::abs(loop.state.steer.slip_rad), 0.05F);
}

// 0.02 rad/s, ten seconds.
TEST(Heading, ASlipThatGoesOnIsSummed) {
  Loop& loop = walking();
  loop.inputs.gyro_count[2] = -19;
  loop.ticks(1000);
  EXPECT_GT(loop.state.steer.slip_rad, 0.1F);
}

// With whole ticks in a cycle, the gyro would see every step at the same moments.
TEST(Heading, HurriedStepsBeginAtAllMomentsOfATick) {
  Loop& loop = walking();
  const auto tick_us = static_cast<std::int32_t>(test::kRobot.period_us);
  loop.walk(4000);
  loop.ticks(600);
  ASSERT_GT(loop.state.gait.queue[0].haste, 0.5F);
  bool tenths[10] = {};
  std::int32_t walked_us = 0;
  for (int tick = 0; tick < 512; ++tick) {
    const std::int32_t before_us = loop.state.gait.clock_us;
    const std::int32_t step_us = loop.state.gait.queue[0].duration_us();
    loop.tick();
    walked_us += loop.state.gait.clock_us - before_us;
    if (loop.state.gait.clock_us > before_us) continue;
    walked_us += step_us;
    const int tenth = loop.state.gait.clock_us * 10 / tick_us;
    tenths[tenth < 10 ? tenth : 9] = true;
  }
  EXPECT_EQ(walked_us, 512 * tick_us);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(tenths[i]) << i << " tenths of a tick";
}

TEST(Heading, ArmsSwingAsTheRobotWalksAndRestAsItStands) {
  Loop& loop = walking();
  std::int32_t most = 0, both = 0;
  loop.walk(1500);
  for (int tick = 0; tick < 400; ++tick) {
    loop.tick();
    const auto off = [&](int j) {
      return loop.outputs.goal_count[j] -
             model::count_of(test::kRobot.joint[j], test::kRobot.joint[j].stand_rad);
    };
    most = off(test::kLeftArm) > most ? off(test::kLeftArm) : most;
    // The right arm counts the other way.
    both += off(test::kLeftArm) * off(test::kRightArm) < 0 ? 1 : 0;
  }
  EXPECT_GT(most, 30) << "counts of 1.5 mrad";
  EXPECT_EQ(both, 0) << "ticks in which both went the same way";
  loop.command.request = Request::kStand;
  ASSERT_GE(loop.until(safety::Mode::kStanding, 1000), 0);
  loop.ticks(10);
  EXPECT_EQ(loop.outputs.goal_count[test::kLeftArm],
            model::count_of(test::kRobot.joint[test::kLeftArm],
                            test::kRobot.joint[test::kLeftArm].stand_rad));
}

}  // namespace
}  // namespace verp::control
