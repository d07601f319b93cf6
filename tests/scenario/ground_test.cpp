#include <string>

#include "tests/scenario/walk.hpp"

// 20 s on ground unknown to the robot, 4 cm in 450 ms. Some seeds fail over plates, and over one as
// high as feet are lifted (shares: common/worlds/README.md).
namespace verp::scenario {
namespace {

Walk expect_walk_there(const std::string& words, double at_least, double ahead_m) {
  const Walk seeds = walk("generic21 --for 20 --physics-step 2 --seeds 1-4 " + words);
  EXPECT_GE(number(seeds, "survived"), at_least) << words;
  double farthest_m = 0;
  for (const json& each : seeds.result.at("walks"))
    farthest_m = std::max(farthest_m, each.value("ahead_m", 0.0));
  EXPECT_GE(farthest_m, ahead_m) << words << ": it walked over it, not before it";
  return seeds;
}

TEST(Ground, FiveDegreesUpAndDownItWalks) {
  expect_walk_there("--world hill", 4, 2.7);
}

// The turn into the slope must not pass for the gyro's bias.
TEST(Ground, AcrossFiveDegreesItWalksAndKnowsItsTilt) {
  const Walk seeds = expect_walk_there("--world bank", 4, 2.7);
  for (const json& each : seeds.result.at("walks")) {
    const json& estimator = each.at("estimator");
    EXPECT_LT(estimator.at("roll_rms_deg").get<double>(), 1.0);
    EXPECT_LT(estimator.at("com_velocity_rms_m_s").get<double>(), 0.03);
  }
}

TEST(Ground, OverPlatesOfThreeToFiveMillimetresItWalks) {
  expect_walk_there("--world rough", 4, 2.7);
}

TEST(Ground, UpAndDownACentimetreItWalks) {
  expect_walk_there("--world ledge", 3, 1.6);
}

// With its toes on the edge it tilts back and must not take that for falling; these seeds once did.
TEST(Ground, WithItsToesOnAnEdgeItGoesOn) {
  for (const char* seed : {"17", "21"}) {
    const Walk over =
        walk(std::string("generic21 --world ledge --for 20 --physics-step 2 --seed ") + seed);
    expect_walked(over);
    EXPECT_GE(number(over, "ahead_m"), 2.0);
  }
}

// A mat that yields by a centimetre.
TEST(Ground, OnASoftFloorItWalks) {
  expect_walk_there("--at '0: ground.contact_stiffness_n_m=5000'", 4, 2.9);
}

}  // namespace
}  // namespace verp::scenario
