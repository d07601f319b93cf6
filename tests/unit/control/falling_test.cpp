#include "common/control/falling.hpp"

#include <gtest/gtest.h>

#include "tests/unit/control/falling_loop.hpp"

namespace verp::control {
namespace {

using namespace test;

TEST(Falling, IsSeenBeforeTheGroundIsMetAndEndsLimp) {
  FallingLoop loop;
  ASSERT_GE(loop.until(Mode::kStanding, 200), 0);
  const double seen_rad = loop.topple(Mode::kFalling);
  EXPECT_GT(seen_rad, 0.25) << "not every sway";
  EXPECT_LT(seen_rad, 0.5) << "half a second before it lies";
  EXPECT_TRUE(loop.has_torque()) << "it bears the ground";
  EXPECT_NEAR(loop.state.limit.goal_rad[kLeftArm], 1.0, 0.01) << "in its pose";
  ASSERT_GE(loop.until(Mode::kFallen, 100), 0);
  EXPECT_FALSE(loop.has_torque());
  EXPECT_NE(loop.outputs.faults & safety::kFaultFall, 0u);
}

TEST(Falling, EndsAWalkForGood) {
  FallingLoop loop;
  ASSERT_GE(loop.until(Mode::kStanding, 200), 0);
  loop.ticks(400);
  loop.walk(500);
  ASSERT_GE(loop.until(Mode::kWalking, 10), 0);
  loop.ticks(100);
  ASSERT_GT(loop.topple(Mode::kFalling), 0);
  EXPECT_EQ(loop.state.gait.queued, 0);
}

TEST(Falling, WithoutItsPoseARobotFallsLimp) {
  FallingLoop loop(false);
  ASSERT_GE(loop.until(Mode::kStanding, 200), 0);
  EXPECT_LT(loop.topple(Mode::kFalling), 0);
  EXPECT_TRUE(loop.is_in(Mode::kFallen));
}

TEST(Falling, OneThatIsCaughtRisesAgain) {
  FallingLoop loop;
  ASSERT_GE(loop.until(Mode::kStanding, 200), 0);
  loop.inputs.gyro_count[1] = 2830;  // 3 rad/s
  ASSERT_GE(loop.until(Mode::kFalling, 30), 0);
  loop.inputs.gyro_count[1] = -2830;
  loop.ticks(8);
  loop.inputs.gyro_count[1] = 0;
  ASSERT_GE(loop.until(Mode::kHolding, 80), 0);
  EXPECT_GE(loop.until(Mode::kStanding, 200), 0);
  EXPECT_EQ(loop.outputs.faults & safety::kFaultFall, 0u);
}

FallingLoop fallen() {
  FallingLoop loop;
  loop.until(Mode::kStanding, 200);
  loop.topple(Mode::kFalling);
  EXPECT_GE(loop.until(Mode::kFallen, 100), 0);
  return loop;
}

TEST(GettingUp, NoTorqueOnTheFloorForWhoDoesNotAskForIt) {
  FallingLoop loop = fallen();
  for (const Request request : {Request::kStand, Request::kWalk}) {
    loop.command.request = request;
    for (int i = 0; i < 300; ++i) {
      loop.tick();
      ASSERT_FALSE(loop.has_torque()) << i;
    }
  }
}

TEST(GettingUp, WaitsUntilItLiesStillAndEndsInTheStand) {
  FallingLoop loop = fallen();
  loop.command.request = Request::kGetUp;
  EXPECT_NEAR(loop.until(Mode::kGettingUp, 200), 100, 2);
  loop.ticks(25);
  EXPECT_NEAR(loop.state.limit.goal_rad[kRightArm], 0.5, 0.05) << "by its action";
  loop.hold_up(0, 8172);
  loop.inputs.gyro_count[1] = -3000;
  loop.ticks(50);
  loop.inputs.gyro_count[1] = 0;
  ASSERT_GE(loop.until(Mode::kStanding, 400), 0);
  EXPECT_EQ(loop.outputs.faults & safety::kFaultFall, 0u) << "it is over";
}

TEST(GettingUp, ThatDoesNotHelpEndsLimp) {
  FallingLoop loop = fallen();
  loop.command.request = Request::kGetUp;
  ASSERT_GE(loop.until(Mode::kGettingUp, 200), 0);
  loop.command.request = Request::kStand;
  ASSERT_GE(loop.until(Mode::kFallen, 1000), 0);
  loop.ticks(200);
  EXPECT_TRUE(loop.is_in(Mode::kFallen)) << "nobody asks any more";
}

TEST(GettingUp, FromPowerUpOnTheFloor) {
  FallingLoop loop;
  loop.hold_up(-8172, 0);
  loop.command.request = Request::kGetUp;
  EXPECT_GE(loop.until(Mode::kGettingUp, 200), 0);
}

// No action rises from the back.
TEST(GettingUp, OnASideWithoutAnActionItStaysDown) {
  FallingLoop loop;
  loop.hold_up(8172, 0);
  loop.command.request = Request::kGetUp;
  for (int i = 0; i < 300; ++i) {
    loop.tick();
    ASSERT_FALSE(loop.has_torque()) << i;
  }
}

TEST(GettingUp, AskedToRelaxItStopsAndIsLimp) {
  FallingLoop loop = fallen();
  loop.command.request = Request::kGetUp;
  ASSERT_GE(loop.until(Mode::kGettingUp, 200), 0);
  loop.ticks(5);
  loop.command.request = Request::kRelax;
  EXPECT_GE(loop.until(Mode::kFallen, 300), 0);
  EXPECT_GE(loop.until(Mode::kRelaxed, 3), 0);
}

TEST(GettingUp, SilenceEndsIt) {
  FallingLoop loop = fallen();
  loop.command.request = Request::kGetUp;
  ASSERT_GE(loop.until(Mode::kGettingUp, 200), 0);
  loop.inputs.fresh = 0;
  ASSERT_GE(loop.until(Mode::kHolding, 20), 0);
  EXPECT_GE(loop.until(Mode::kFallen, 3), 0);
}

}  // namespace
}  // namespace verp::control
