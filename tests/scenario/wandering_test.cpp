#include <gtest/gtest.h>

#include "common/safety/machine.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::scenario {
namespace {

TEST(Generic21, FollowsChangingVelocitiesInMidWalk) {
  const test::Robot robot = test::load_robot("generic21");
  const test::TwinRun run = test::run_here(robot, 2700, true);
  EXPECT_FALSE(run.fallen);
  EXPECT_EQ(run.records.size(), 2700u);
  EXPECT_GT(run.distance_m, 0.2);
}

}  // namespace
}  // namespace verp::scenario
