#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

// Robots of other people. They walk, and get somewhere.
void expect_walks(const char* model) {
  const Walk result = walk(std::string(model) + " --for 20");
  expect_walked(result);
  expect_between(1.5, number(result, "ahead_m"), 4.0, "way ahead, m");
}

TEST(ThirdParty, Op3Walks) {
  expect_walks("op3");
}

// Four seeds, because one seed's joint zeros and accelerometer move its bias by 2 mm.
TEST(ThirdParty, Op3WalksWithItsZmpUnderItsSoles) {
  double sum_mm = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    const Walk minute = walk("op3 --for 60 --seed " + std::to_string(seed));
    expect_walked(minute);
    sum_mm += number(minute, "zmp_bias_mean_mm");
  }
  expect_between(2.0, sum_mm / 4, 15.0, "mean ZMP bias, mm");
}

// Its feet cannot feel. Its encoders' zeros are learnt all the same: seed 1 limped, with 32 mm.
TEST(ThirdParty, Op3LearnsItsZeros) {
  const double learnt_mm = number(walk("op3 --for 20"), "zmp_bias_mean_mm");
  EXPECT_LT(learnt_mm, 0.7 * number(walk("op3 --for 20 --no-zeros"), "zmp_bias_mean_mm"));
}

TEST(ThirdParty, DarwinOpWalks) {
  expect_walks("darwin_op");
}

// Knees that are bent the wrong way at zero, axes that don't meet, one motor for both hips' yaws,
// fingers, massless links, and a wrapper that gives no gait, gain or pose at all.
TEST(ThirdParty, OddRobotWalksFromTheLeastWrapper) {
  const Walk result =
      walk(VERP_SOURCE_DIR "/tests/host/model/odd_robot/robot.sdf --for 30 --physics-step 2");
  expect_walked(result);
  expect_between(2.5, number(result, "ahead_m"), 6.5, "way ahead, m");
  EXPECT_EQ(result.result.value("notes", "").find("out of reach"), std::string::npos);
}

}  // namespace
}  // namespace verp::scenario
