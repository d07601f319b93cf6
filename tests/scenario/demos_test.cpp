#include "tests/scenario/demos.hpp"

namespace verp::scenario {
namespace {

// Bands set by hand around a few runs, inside the demo's own criterion.
TEST(Demos, AColumnKeepsItsFormation) {
  const demos::Run run = good("column", 1);
  expect_fact(run, "guide's way", 3.4, 4.2);
  expect_fact(run, "guide turned", 1.4, 1.9);
  for (const char* robot : {"r2", "r3", "r4"}) {
    expect_fact(run, std::string(robot) + " from its place, rms", 0.005, 0.10);
    expect_fact(run, std::string(robot) + " at most", 0.01, 0.25);
  }
}

TEST(Demos, FollowersKeepToTheLeadersWay) {
  const demos::Run run = good("follow", 1);
  expect_fact(run, "leader's way", 3.5, 4.5);
  for (const char* robot : {"r2", "r3"}) {
    expect_fact(run, std::string(robot) + " beside the leader's way, rms", 0.003, 0.06);
    expect_fact(run, std::string(robot) + " behind the one ahead, least", 0.6, 0.8);
  }
}

TEST(Demos, OneFindsItsGoalThroughRooms) {
  const demos::Run run = good("goal", 1);
  expect_fact(run, "from the goal at the end", 0.005, 0.2);
  expect_fact(run, "way", 5.5, 9);  // straight through two walls: 3.1 m
}

#ifdef VERP_HAS_CAMERA
TEST(Demos, TwoBringABallToAGoal) {
  const demos::Run run = good("ball", 1);
  expect_fact(run, "ball's way ahead", 1, 4);
  expect_fact(run, "first touched after", 8, 25);
}
#endif

TEST(Demos, FailWithoutRadio) {
  demos::Options options;
  options.robots = 2;
  options.for_s = 12;
  options.radio.loss = 1;
  const demos::Run run = demos::run(demo_of("follow"), options);
  EXPECT_NE(run.verdict.failure, "");
  const demos::Track& follower = run.robots.at(1);
  EXPECT_LT(length(follower.moments.back().real.at_m - follower.moments.front().real.at_m), 0.1);
}

}  // namespace
}  // namespace verp::scenario
