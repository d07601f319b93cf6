#include "common/action/player.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/math/linear.hpp"
#include "common/math/scalar.hpp"
#include "tests/unit/action/shelf.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::action {
namespace {

using namespace verp::test;
using test::Shelf;

constexpr int kJoint = kRightArm;
constexpr float kThere_rad = 0.8F;

struct Stage {
  explicit Stage(const Shelf& with) : shelf(with) {
    for (int j = 0; j < kJointCount; ++j) stand_rad[j] = kRobot.joint[j].stand_rad;
    in.asked = 1;
    in.may_begin = true;
    in.stand_rad = stand_rad;
  }
  float tick() {
    out = update(kRobot, shelf.library(), state, in);
    return out.angle_rad[kJoint];
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  Shelf shelf;
  float stand_rad[kMaxJoints] = {};
  PlayerState state;
  PlayerIn in;
  PlayerOut out;
};

Shelf up_and_down() {
  Shelf shelf;
  shelf.goal(0, kJoint, kThere_rad);
  shelf.goal(1, kJoint, kRobot.joint[kJoint].stand_rad);
  return shelf;
}

TEST(Player, BeginsAtTheStandAndMeetsEachKeyFrame) {
  Stage stage(up_and_down());
  EXPECT_FLOAT_EQ(stage.tick(), stage.stand_rad[kJoint]);
  stage.ticks(20);
  EXPECT_NEAR(stage.out.angle_rad[kJoint], kThere_rad, 1e-4);
  stage.ticks(20);
  EXPECT_NEAR(stage.out.angle_rad[kJoint], stage.stand_rad[kJoint], 1e-3);
}

TEST(Player, NeverLeapsFromTickToTick) {
  Stage stage(up_and_down());
  float before = stage.tick();
  for (int i = 0; i < 200; ++i) {
    const float now = stage.tick();
    if (stage.state.number == 0) break;
    // A minimum-jerk curve peaks at 15/8 of its mean.
    EXPECT_LT(math::abs(now - before), 1.9F * kThere_rad / 20);
    before = now;
  }
}

TEST(Player, EndsAndLeavesNothingButThatItWasAsked) {
  Stage stage(up_and_down());
  stage.tick();
  int most = 300;
  while (stage.state.number != 0 && --most > 0) stage.tick();
  ASSERT_GT(most, 0) << "it never ended";
  PlayerState rest;
  rest.asked = 1;
  EXPECT_EQ(__builtin_memcmp(&stage.state, &rest, sizeof rest), 0);
  stage.ticks(50);
  EXPECT_EQ(stage.state.number, 0) << "once for each asking";
  stage.in.asked = 0;
  stage.tick();
  stage.in.asked = 1;
  stage.tick();
  EXPECT_EQ(stage.state.number, 1) << "asked anew";
}

TEST(Player, WithoutAnActionItsStateIsZeroWhateverIsAsked) {
  Stage stage(up_and_down());
  const PlayerState zero;
  for (int asked = 0; asked < 256; ++asked) {
    if (asked == 1 || asked == 2) continue;
    stage.in.asked = static_cast<std::uint8_t>(asked);
    stage.tick();
    EXPECT_EQ(__builtin_memcmp(&stage.state, &zero, sizeof zero), 0) << asked;
  }
}

TEST(Player, ToldToStopItReturnsFromAnywhereWithoutALeap) {
  for (int when = 1; when < 40; ++when) {
    Stage stage(up_and_down());
    float before = stage.tick();
    for (int i = 0; i < 400 && stage.state.number != 0; ++i) {
      stage.in.stop = i >= when;
      const float now = stage.tick();
      if (stage.state.number == 0) break;
      EXPECT_LT(math::abs(now - before), 0.1F);
      before = now;
    }
    EXPECT_EQ(stage.state.number, 0);
    EXPECT_NEAR(before, stage.stand_rad[kJoint], 0.02) << "stopped in tick " << when;
  }
}

TEST(Player, AnExitIsGoneToAtTheEndOfTheFrame) {
  Shelf shelf = up_and_down();
  shelf.frame[0].pause_ms = 5000;
  shelf.frame[0].exit = 1;
  shelf.seal();
  Stage stage(shelf);
  stage.tick();
  stage.in.stop = true;
  stage.ticks(10);
  EXPECT_EQ(stage.state.frame, 0) << "a foot in the air comes down where it should";
  stage.ticks(11);
  EXPECT_EQ(stage.state.frame, 1) << "and the rest is left out";
}

TEST(Player, RepeatsAsOftenAsItSays) {
  Shelf shelf = up_and_down();
  shelf.frame[1].loop_to = 0;
  shelf.frame[1].loops = 3;
  shelf.seal();
  Stage stage(shelf);
  int visits = 0, frame = -1;
  for (int i = 0; i < 1000; ++i) {
    stage.tick();
    if (stage.state.number == 0) break;
    if (stage.state.part == Part::kFrame && stage.state.frame != frame) {
      frame = stage.state.frame;
      visits += frame == 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(visits, 4);
}

TEST(Player, WaitsForItsConditionAndElseGoesTheOtherWay) {
  Shelf shelf = up_and_down();
  shelf.frame[0].condition = Condition::kLeftFoot;
  shelf.frame[0].wait_ms = 300;
  shelf.frame[0].otherwise = 2;
  shelf.goal(2, kJoint, 0.1F);
  for (const bool comes : {true, false}) {
    Stage stage(shelf);
    stage.ticks(31);
    EXPECT_EQ(stage.state.frame, 0) << "it waits";
    stage.in.pressed[0] = comes;
    stage.ticks(comes ? 1 : 20);
    EXPECT_EQ(stage.state.frame, comes ? 1 : 2);
  }
}

TEST(Player, AJointThatNoFrameNamesStands) {
  Stage stage(up_and_down());
  stage.ticks(15);
  stage.stand_rad[kHead] = 0.3F;
  stage.tick();
  EXPECT_FLOAT_EQ(stage.out.angle_rad[kHead], 0.3F);
}

TEST(Player, EachFrameRepeatsAsOftenAsItSaysAndLosesNoTime) {
  for (const std::int32_t period_us : {7000, 10000, 12500}) {
    for (int repeats = 0; repeats < 16; ++repeats) {
      Shelf shelf = up_and_down();
      for (int i = 0; i < 2; ++i) {
        shelf.frame[i].loop_to = static_cast<std::uint16_t>(i);
        shelf.frame[i].loops = static_cast<std::uint8_t>(i == 0 ? repeats % 4 : repeats / 4);
      }
      shelf.seal();
      Stage stage(shelf);
      stage.in.period_us = period_us;
      stage.tick();
      int ticks = 0;
      for (; stage.state.part == Part::kFrame && ticks < 300; ++ticks) stage.tick();
      const int frames = repeats % 4 + repeats / 4 + 2;
      EXPECT_EQ(ticks, (200'000 * frames + period_us - 1) / period_us) << repeats;
    }
  }
}

// The world's z of the body's axes says how it lies.
TEST(Player, LeavesAFrameOnlyIfItsConditionHolds) {
  for (int i = 0; i < 10 * 49; ++i) {
    const float roll_rad = 0.9F * static_cast<float>(i / 10 % 7 - 3) + 0.05F;
    const float pitch_rad = 0.5F * static_cast<float>(i / 70 - 3) + 0.02F;
    const Mat3 body = math::rotation_rpy(roll_rad, pitch_rad, 1.0F);
    const float ahead = body(2, 0), left = body(2, 1), up = body(2, 2);
    const bool pressed[] = {i / 10 % 2 != 0, i / 20 % 2 != 0}, lies = up < 0.5F;
    const bool sideways = math::abs(left) > math::abs(ahead);
    const bool holds[] = {true,
                          up > 0.9F,
                          lies && !sideways && ahead < 0,
                          lies && !sideways && ahead > 0,
                          lies && sideways && left < 0,
                          lies && sideways && left > 0,
                          pressed[0],
                          pressed[1],
                          pressed[0] && pressed[1],
                          !pressed[0] && !pressed[1]};
    Shelf shelf = up_and_down();
    shelf.frame[0].condition = static_cast<Condition>(i % 10);
    shelf.frame[0].wait_ms = 1000;
    shelf.seal();
    Stage stage(shelf);
    stage.in.roll_rad = roll_rad;
    stage.in.pitch_rad = pitch_rad;
    stage.in.up = up;
    for (int side = 0; side < kFeet; ++side) stage.in.pressed[side] = pressed[side];
    stage.ticks(21);
    EXPECT_EQ(stage.state.frame == 1, holds[i % 10])
        << i % 10 << ", " << roll_rad << ", " << pitch_rad;
  }
}

}  // namespace
}  // namespace verp::action
