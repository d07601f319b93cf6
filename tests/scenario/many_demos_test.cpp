#include "tests/scenario/demos.hpp"

namespace verp::scenario {
namespace {

constexpr std::uint64_t kSeeds = 6;

TEST(ManyDemos, ColumnsKeepTheirFormation) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) good("column", seed);
}

TEST(ManyDemos, FollowersKeepToTheLeadersWay) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) good("follow", seed);
}

TEST(ManyDemos, GoalsAreFound) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) good("goal", seed);
}

#ifdef VERP_HAS_CAMERA
TEST(ManyDemos, BallsComeToAGoal) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) good("ball", seed);
}
#endif

// A third of all messages is lost, with half seconds of silence.
TEST(ManyDemos, ABadRadioIsBorne) {
  demos::Options options;
  options.radio.loss = 0.33;
  options.radio.fade = 0.1;
  options.radio.fade_s = 0.5;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    good("column", seed, options);
    good("follow", seed, options);
  }
}

}  // namespace
}  // namespace verp::scenario
