#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

// Steps of 0.5, 1 and 2 ms differ by 0.4 % of speed; the cheap step may cost 1 % and 1 mm. Three
// seeds, because chance moves a walk's bias by a millimetre.
TEST(PhysicsStep, TwoMillisecondsWalkLikeOne) {
  constexpr int kSeeds = 3;
  double speed_m_s[3] = {}, bias_mm[3] = {};  // by step in ms
  for (int step_ms = 1; step_ms <= 2; ++step_ms) {
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const Walk one = walk("generic21 --for 20 --seed " + std::to_string(seed) +
                            " --physics-step " + std::to_string(step_ms));
      expect_walked(one);
      EXPECT_EQ(one.result.value("physics_step_ms", 0.0), step_ms);
      speed_m_s[step_ms] += number(one, "speed_steady_m_s") / kSeeds;
      bias_mm[step_ms] += number(one, "zmp_bias_mean_mm") / kSeeds;
    }
  }
  EXPECT_NEAR(speed_m_s[2], speed_m_s[1], 0.01 * speed_m_s[1]);
  EXPECT_NEAR(bias_mm[2], bias_mm[1], 1.0);
}

// The controller does not know the variation (host/twin/sim/vary.hpp).
TEST(RandomRobots, NineteenOfTwentyWalk) {
  const Walk seeds = walk("generic21 --vary --for 20 --physics-step 2 --seeds 1-20");
  EXPECT_GE(number(seeds, "survived"), 19);
}

TEST(RandomRobots, SixOfSixWalk) {
  const Walk seeds = walk("generic21 --vary --for 10 --physics-step 2 --seeds 1-6");
  EXPECT_EQ(number(seeds, "survived"), 6);
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
