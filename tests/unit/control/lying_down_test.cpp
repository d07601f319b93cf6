#include <gtest/gtest.h>

#include "tests/unit/control/falling_loop.hpp"

namespace verp::control {
namespace {

using namespace test;

/// Both arms to 0.5 rad, then to 0.8 rad.
action::test::Shelf lying_shelf() {
  action::test::Shelf shelf = falling_shelf();
  __builtin_memcpy(shelf.action[0].name, action::kLieDown, kNameLength);
  for (const int joint : {kLeftArm, kRightArm}) shelf.goal(1, joint, 0.8F);
  shelf.seal();
  return shelf;
}
const action::test::Shelf kLyingShelf = lying_shelf();

FallingLoop lying_down() {
  FallingLoop loop;
  loop.actions = kLyingShelf.library();
  loop.until(Mode::kStanding, 200);
  loop.command.request = Request::kRelax;
  EXPECT_GE(loop.until(Mode::kSitting, 5), 0);
  EXPECT_GE(loop.until(Mode::kLyingDown, 400), 0);
  return loop;
}

TEST(LyingDown, BeginsInTheCrouchAndLetsGoWhereItsActionEnds) {
  FallingLoop loop = lying_down();
  for (int j = 0; j < kJointCount; ++j) {
    EXPECT_NEAR(loop.state.limit.goal_rad[j], kRobot.joint[j].sit_rad, 2e-3F) << j;
  }
  float last_rad = 0;
  while (loop.is_in(Mode::kLyingDown)) {
    ASSERT_TRUE(loop.has_torque());
    last_rad = loop.state.limit.goal_rad[kLeftArm];
    loop.tick();
    ASSERT_LT(loop.inputs.tick, 2000U);
  }
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed));
  EXPECT_FALSE(loop.has_torque());
  EXPECT_NEAR(last_rad, 0.8F, 1e-3F) << "not on its way back to the stand";
}

TEST(LyingDown, IsNotEndedByAFallASilenceOrAnOrder) {
  FallingLoop loop = lying_down();
  loop.hold_up(8172, 0);
  loop.inputs.fresh = 0;
  for (const Request request : {Request::kStand, Request::kWalk, Request::kGetUp}) {
    loop.command.request = request;
    loop.ticks(15);
    EXPECT_TRUE(loop.is_in(Mode::kLyingDown));
    EXPECT_TRUE(loop.has_torque());
  }
  EXPECT_EQ(loop.outputs.faults & safety::kFaultFall, 0U);
}

TEST(LyingDown, IsEndedAtOnceByTheEmergencyStop) {
  FallingLoop loop = lying_down();
  loop.inputs.flags |= kEmergencyStop;
  loop.tick();
  EXPECT_TRUE(loop.is_in(Mode::kStopped));
  EXPECT_FALSE(loop.has_torque());
}

TEST(LyingDown, LeavesARobotThatRefusesToStandWithoutARequestToGetUp) {
  FallingLoop loop = lying_down();
  loop.hold_up(8172, 0);
  ASSERT_GE(loop.until(Mode::kRelaxed, 400), 0);
  loop.command.request = Request::kStand;
  for (int i = 0; i < 300; ++i) {
    loop.tick();
    ASSERT_FALSE(loop.has_torque()) << i;
  }
}

TEST(LyingDown, NeverOutlastsItsAction) {
  FallingLoop loop = lying_down();
  loop.ticks(10);
  loop.state.action = action::PlayerState{};
  loop.tick();
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed));
}

TEST(LyingDown, NeedsItsAction) {
  FallingLoop loop;
  ASSERT_GE(loop.until(Mode::kStanding, 200), 0);
  loop.command.request = Request::kRelax;
  ASSERT_GE(loop.until(Mode::kSitting, 5), 0);
  while (loop.is_in(Mode::kSitting)) loop.tick();
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed));
}

}  // namespace
}  // namespace verp::control
