#include "tests/scenario/walk.hpp"

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

TEST(PapersWalk, OfTenSeedsLastsAMinute) {
  const Walk seeds = walk("generic21 --step 0.04 --cycle 0.45 --for 60 --seeds 1-10");
  EXPECT_EQ(number(seeds, "survived"), 10);
  for (const json& each : seeds.result.value("walks", json::array())) {
    expect_between(0.170, each.value("speed_steady_m_s", 0.0), 0.190, "steady speed, m/s");
    expect_between(2.0, each.value("zmp_bias_mean_mm", 0.0), 12.0, "mean ZMP bias, mm");
  }
}

TEST(FastestWalk, OfTenSeedsLastsAMinute) {
  const Walk seeds = walk("generic21 --step 0.08 --cycle 0.4 --for 60 --seeds 1-10");
  EXPECT_EQ(number(seeds, "survived"), 10);
  for (const json& each : seeds.result.value("walks", json::array())) {
    expect_between(0.40, each.value("speed_steady_m_s", 0.0), 0.44, "steady speed, m/s");
  }
}

}  // namespace
}  // namespace verp::scenario
