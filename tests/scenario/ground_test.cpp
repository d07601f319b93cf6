#include <string>

#include "tests/scenario/walk.hpp"

// Ground that nobody told the robot of, 20 s of it at 4 cm in 450 ms: it walks by what it feels
// under its soles and where its body tilts. Robots of several seeds: over plates, and over one as
// high as its feet are lifted, some do not manage it (shares: common/worlds/README.md).
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

// Upright, and the turn into it is not taken for the gyro's bias: that was 1.7 degrees.
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

// Both feet with their toes on the edge tilt it back, and it took itself for falling: these stayed
// there, and went 0.7 and 1.0 m.
TEST(Ground, WithItsToesOnAnEdgeItGoesOn) {
  for (const char* seed : {"17", "21"}) {
    const Walk over =
        walk(std::string("generic21 --world ledge --for 20 --physics-step 2 --seed ") + seed);
    expect_walked(over);
    EXPECT_GE(number(over, "ahead_m"), 2.0);
  }
}

// A mat that gives way by a centimetre under its weight.
TEST(Ground, OnASoftFloorItWalks) {
  expect_walk_there("--at '0: ground.contact_stiffness_n_m=5000'", 4, 2.9);
}

}  // namespace
}  // namespace verp::scenario
