#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

// The physics step of many runs: half the price, and the same walk. Evidence had 0.4 % of speed
// between steps of 0.5, 1 and 2 ms; 1 % and 1 mm are what it may cost.
TEST(PhysicsStep, TwoMillisecondsWalkLikeOne) {
  const char* const robot = "generic21 --for 30 --seed 1 --physics-step ";
  const Walk fine = walk(robot + std::string("1")), coarse = walk(robot + std::string("2"));
  expect_walked(fine);
  expect_walked(coarse);
  const double speed_m_s = number(fine, "speed_steady_m_s");
  EXPECT_NEAR(number(coarse, "speed_steady_m_s"), speed_m_s, 0.01 * speed_m_s);
  EXPECT_NEAR(number(coarse, "zmp_bias_mean_mm"), number(fine, "zmp_bias_mean_mm"), 1.0);
  EXPECT_EQ(fine.result.value("physics_step_ms", 0.0), 1.0);
  EXPECT_EQ(coarse.result.value("physics_step_ms", 0.0), 2.0);
}

// Robots drawn at random (host/sim/vary.hpp) are walked by a controller that knows nothing of it.
TEST(RandomRobots, NineteenOfTwentyWalk) {
  const Walk seeds = walk("generic21 --vary --for 20 --physics-step 2 --seeds 1-20");
  EXPECT_GE(number(seeds, "survived"), 19);
}

TEST(RandomRobots, WalksSayWhatWasDrawnAndWhoSurvived) {
  const Walk seeds = walk("generic21 --vary --for 3 --physics-step 2 --seeds 1-6");
  const json walks = seeds.result.value("walks", json::array());
  ASSERT_EQ(walks.size(), 6u);
  int survived = 0;
  for (const json& each : walks) {
    survived += each.at("survived").get<bool>() ? 1 : 0;
    EXPECT_GE(each.at("varied").at("friction").get<double>(), 0.4);
    EXPECT_LE(each.at("varied").at("goal_delay_s").get<double>(), 0.020);
  }
  EXPECT_EQ(number(seeds, "survived"), survived);
  EXPECT_EQ(seeds.status, survived == 6 ? 0 : 1) << "who asks for walks wants to know of falls";
}

// One of the many is the one that --seed walks.
TEST(RandomRobots, ASeedIsTheSameRobotAloneAndAmongMany) {
  const std::string options = "generic21 --vary --for 3 --physics-step 2 ";
  const Walk alone = walk(options + "--seed 4"), many = walk(options + "--seeds 3-4");
  const json walks = many.result.value("walks", json::array());
  ASSERT_EQ(walks.size(), 2u);
  EXPECT_EQ(walks[1].at("digest"), alone.result.at("digest"));
  EXPECT_EQ(walks[1].at("varied"), alone.result.at("varied"));
  EXPECT_NE(walks[0].at("digest"), walks[1].at("digest"));
}

}  // namespace
}  // namespace verp::scenario
