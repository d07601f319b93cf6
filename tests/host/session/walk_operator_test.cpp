#include "host/run/session/walk_operator.hpp"

#include <gtest/gtest.h>

#include "common/safety/machine.hpp"

namespace verp::session {
namespace {

using safety::Mode;

struct Watched {
  explicit Watched(bool stands) : watcher(params(), {.vx_tenth_mm_s = 1000}, 2, 0, stands) {
    state.attitude.still_s = balance::kBestKnown_s;
  }
  static const Params& params() {
    static const Params robot = [] {
      Params made;
      made.period_us = 10000;
      return made;
    }();
    return robot;
  }
  void is(Mode mode, double for_s, bool steps = false) {
    outputs.mode = static_cast<std::uint8_t>(mode);
    outputs.gait_phase =
        static_cast<std::uint8_t>(steps ? gait::Phase::kStart : gait::Phase::kIdle);
    state.gait.queued = steps ? 2 : 0;
    for (int i = 0; i < for_s / 0.01; ++i) watcher.observe(state, outputs);
  }
  Request asks() { return watcher.order(0).command.request; }

  WalkOperator watcher;
  State state;
  Outputs outputs;
};

// A pushed robot steps before the ordered walk.
TEST(WalkOperator, StepsBeforeTheWalkAreNoGaitOfIt) {
  Watched robot(false);
  robot.is(Mode::kRising, 1);
  robot.is(Mode::kStanding, 0.3);
  robot.is(Mode::kWalking, 1, true);
  EXPECT_EQ(robot.asks(), Request::kStand);
  EXPECT_EQ(robot.watcher.walked_s(), 0);
  robot.is(Mode::kStanding, 0.4);
  EXPECT_EQ(robot.asks(), Request::kStand) << "it has to stand quietly first";
  robot.is(Mode::kStanding, 0.2);
  EXPECT_EQ(robot.asks(), Request::kWalk);
  EXPECT_FALSE(robot.watcher.done());
}

TEST(WalkOperator, WhoStandsIsNeverAskedToWalkAndEndsInTheStand) {
  Watched robot(true);
  robot.is(Mode::kStanding, 0.52);
  robot.is(Mode::kStanding, 1.8);
  robot.is(Mode::kWalking, 1, true);
  EXPECT_FALSE(robot.watcher.done()) << "it has to come to stand again";
  EXPECT_EQ(robot.asks(), Request::kStand);
  robot.is(Mode::kStanding, 0.02);
  EXPECT_TRUE(robot.watcher.done());
  EXPECT_EQ(robot.watcher.failed(), "");
}

TEST(WalkOperator, WhoStandsBeginsWhenTheGyroIsKnown) {
  Watched robot(true);
  robot.state.attitude.still_s = 0;
  robot.is(Mode::kStanding, 5);
  EXPECT_EQ(robot.watcher.walked_s(), 0);
  robot.state.attitude.still_s = balance::kCalibrated_s;
  robot.is(Mode::kStanding, 1);
  EXPECT_NEAR(robot.watcher.walked_s(), 0.5, 0.02);
}

// The core allows a walk sooner, with twice the heading error. A trembling robot does not wait for
// ever.
TEST(WalkOperator, WhoWalksWaitsForTheBestOfItsGyroButNotForEver) {
  for (const bool trembles : {false, true}) {
    Watched robot(false);
    robot.state.attitude.still_s = balance::kCalibrated_s;
    robot.is(Mode::kStanding, 7);
    EXPECT_EQ(robot.asks(), Request::kStand);
    if (!trembles) robot.state.attitude.still_s = balance::kBestKnown_s;
    robot.is(Mode::kStanding, 0.6);
    EXPECT_EQ(robot.asks(), trembles ? Request::kStand : Request::kWalk);
    robot.is(Mode::kStanding, 1.2);
    EXPECT_EQ(robot.asks(), Request::kWalk);
  }
}

// State does not say how long to wait.
TEST(WalkOperator, WhoseControllerLearnsNoGyroIsNotWaitedFor) {
  Watched robot(false);
  robot.state = {};
  robot.is(Mode::kStanding, 1.9);
  EXPECT_EQ(robot.asks(), Request::kStand);
  robot.is(Mode::kStanding, 0.8);
  EXPECT_EQ(robot.asks(), Request::kWalk);
}

TEST(WalkOperator, WhoNeverStandsOrStepsForEverFailsAndSaysWhy) {
  Watched never(true);
  never.is(Mode::kRelaxed, 16);
  EXPECT_TRUE(never.watcher.done());
  EXPECT_EQ(never.watcher.failed().rfind("the robot did not stand: after 15 s it is ", 0), 0U);
  Watched for_ever(true);
  for_ever.is(Mode::kStanding, 1);
  for_ever.is(Mode::kWalking, 8, true);
  EXPECT_TRUE(for_ever.watcher.done());
  EXPECT_EQ(for_ever.watcher.failed(), "the robot did not come to stand again");
}

TEST(WalkOperator, AWalkThatNeverBeginsNamesItsReason) {
  Watched rises(false);
  rises.is(Mode::kRising, 16);
  EXPECT_EQ(rises.watcher.failed(),
            "the robot did not start to walk: after 15 s it is rising, not standing");
  Watched refuses(false);
  refuses.is(Mode::kStanding, 1);
  refuses.outputs.faults = safety::kNotePlanRefused;
  refuses.is(Mode::kStanding, 16);
  EXPECT_EQ(refuses.watcher.failed(),
            "the robot did not start to walk: no gait began, and its controller noted: plan "
            "refused");
}

}  // namespace
}  // namespace verp::session
