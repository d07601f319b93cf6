#include "tests/scenario/walk.hpp"

// `verp test --full`: a hundred robots of each kind, drawn at random, as the twin's reference steps
// them.
namespace verp::scenario {
namespace {

double survived_of_100(const std::string& robot) {
  return number(walk(robot + " --vary --for 30 --seeds 1-100"), "survived");
}

TEST(HundredRandomRobots, OfGeneric21Walk) {
  EXPECT_GE(survived_of_100("generic21"), 93);
}
TEST(HundredRandomRobots, OfOp3Walk) {
  EXPECT_GE(survived_of_100("op3"), 80);
}
TEST(HundredRandomRobots, OfDarwinOpWalk) {
  EXPECT_GE(survived_of_100("darwin_op"), 80);
}

}  // namespace
}  // namespace verp::scenario
