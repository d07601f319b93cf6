#include "common/control/acting.hpp"

#include <gtest/gtest.h>

#include "tests/unit/action/shelf.hpp"
#include "tests/unit/control/loop.hpp"

namespace verp::control {
namespace {

using namespace test;

/// Both arms and a knee, 0.4 s; and one of the head.
action::test::Shelf shelf() {
  action::test::Shelf shelf;
  for (const int joint : {kLeftArm, kRightArm, kLeftLeg + 3}) {
    shelf.goal(0, joint, kRobot.joint[joint].stand_rad + 0.3F);
    shelf.goal(1, joint, kRobot.joint[joint].stand_rad);
  }
  shelf.goal(2, kHead, 0.4F);
  return shelf;
}

const action::test::Shelf kShelf = shelf();

struct ActingLoop : Loop {
  ActingLoop() {
    actions = kShelf.library();
    command.request = Request::kStand;
  }
  void stand() {
    until(Mode::kStanding, 1000);
    ticks(400);
  }
};

TEST(Acting, BeginsFromTheStandAndEndsThere) {
  ActingLoop loop;
  loop.stand();
  loop.inputs.action = 1;
  ASSERT_GE(loop.until(Mode::kActing, 5), 0);
  float farthest = 0;
  while (loop.is_in(Mode::kActing)) {
    loop.tick();
    farthest = math::max(farthest, loop.state.limit.goal_rad[kLeftArm]);
    ASSERT_LT(loop.inputs.tick, 3000U) << "it never ends";
  }
  EXPECT_TRUE(loop.is_in(Mode::kStanding));
  EXPECT_NEAR(farthest, kRobot.joint[kLeftArm].stand_rad + 0.3F, 0.01);
  loop.ticks(100);
  EXPECT_TRUE(loop.is_in(Mode::kStanding)) << "once for each asking";
}

TEST(Acting, NeverBeginsWithoutAStand) {
  ActingLoop loop;
  loop.inputs.action = 1;
  loop.command.request = Request::kRelax;
  loop.ticks(50);
  EXPECT_TRUE(loop.is_in(Mode::kRelaxed));
  loop.command.request = Request::kStand;
  while (!loop.is_in(Mode::kStanding)) {
    loop.tick();
    ASSERT_FALSE(loop.is_in(Mode::kActing));
    ASSERT_LT(loop.inputs.tick, 2000U);
  }
}

TEST(Acting, AWalkEndsFirstAndGoesOnAfterwards) {
  ActingLoop loop;
  loop.walk(500);
  ASSERT_GE(loop.until(Mode::kWalking, 1000), 0);
  loop.ticks(200);
  loop.inputs.action = 1;
  ASSERT_GE(loop.until(Mode::kStanding, 600), 0);
  EXPECT_EQ(loop.state.gait.queued, 0) << "on both feet";
  ASSERT_GE(loop.until(Mode::kActing, 5), 0);
  ASSERT_GE(loop.until(Mode::kWalking, 600), 0);
}

TEST(Acting, AskedToRelaxItReturnsToTheStandBeforeItSits) {
  ActingLoop loop;
  loop.stand();
  loop.inputs.action = 1;
  ASSERT_GE(loop.until(Mode::kActing, 5), 0);
  loop.ticks(10);
  loop.command.request = Request::kRelax;
  std::int32_t before = loop.outputs.goal_count[kLeftArm];
  while (!loop.is_in(Mode::kSitting)) {
    loop.tick();
    EXPECT_LT(std::abs(loop.outputs.goal_count[kLeftArm] - before), 40) << "a leap";
    before = loop.outputs.goal_count[kLeftArm];
    ASSERT_LT(loop.inputs.tick, 3000U);
  }
}

TEST(Acting, SilenceFreezesAnAction) {
  ActingLoop loop;
  loop.stand();
  loop.inputs.action = 1;
  ASSERT_GE(loop.until(Mode::kActing, 5), 0);
  loop.ticks(10);
  loop.inputs.fresh = 0;
  ASSERT_GE(loop.until(Mode::kHolding, 100), 0);
  const std::int32_t goal = loop.outputs.goal_count[kLeftArm];
  loop.ticks(5);
  EXPECT_EQ(loop.outputs.goal_count[kLeftArm], goal);
}

TEST(Acting, ALibraryThatNobodyAsksOfChangesNoBit) {
  ActingLoop with;
  Loop without;
  without.command.request = Request::kStand;
  for (int i = 0; i < 600; ++i) {
    if (i == 400) with.walk(500), without.walk(500);
    with.inputs.action = without.inputs.action = static_cast<std::uint8_t>(i >= 500 ? 7 : 0);
    with.tick();
    without.tick();
    ASSERT_EQ(with.state.digest.chain, without.state.digest.chain) << i;
  }
}

// Changes with kCoreVersion.
constexpr std::uint64_t kPlayed = 0x3e6ad6c7c6a05f0e;

TEST(Acting, IsTheSameBitsOnEveryCore) {
  ActingLoop loop;
  loop.stand();
  loop.inputs.action = 1;
  loop.ticks(100);
  loop.inputs.action = 2;
  loop.ticks(100);
  EXPECT_EQ(loop.state.digest.chain, kPlayed) << std::hex << loop.state.digest.chain;
}

/// The head's goal half-way to 0.4 rad, while it is at `at_rad`.
float acted_rad(int stiffness_percent, float at_rad) {
  action::test::Shelf raises = shelf();
  raises.frame[2].stiffness_percent[kHead] = static_cast<std::uint8_t>(stiffness_percent);
  raises.seal();
  State& state = fresh_loop().state;
  state.machine.mode = Mode::kActing;
  Inputs inputs;
  inputs.action = 2;
  inputs.position_count[kHead] = model::count_of(kRobot.joint[kHead], at_rad);
  static Wanted wanted;
  wanted = Wanted{};
  for (int i = 0; i <= 10; ++i) {
    act(kRobot, raises.library(), state, inputs, AdmitOut{}, balance::AttitudeOut{}, wanted);
    state.machine.in_mode_us = 1;
  }
  return wanted.angle_rad[kHead];
}

TEST(Acting, AServoOfLessStiffnessGetsThatShareOfTheWayThatIsLeft) {
  for (const int percent : {0, 1, 25, 60, 99, 100}) {
    for (const float at_rad : {-0.5F, 0.1F, 0.7F}) {
      const double expected_rad = at_rad + 0.01 * percent * (0.2 - double{at_rad});
      EXPECT_NEAR(acted_rad(percent, at_rad), expected_rad, 1e-3)
          << percent << " % from " << at_rad;
    }
  }
}

}  // namespace
}  // namespace verp::control
