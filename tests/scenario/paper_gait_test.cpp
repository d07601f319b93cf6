#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/scenario/walk.hpp"

// 16 states, recorded from a walk and played as an action.
namespace verp::scenario {
namespace {

namespace fs = std::filesystem;

class PaperGait : public ::testing::Test {
 protected:
  PaperGait() { fs::create_directories(folder_); }
  ~PaperGait() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  struct Way {
    double m = 0, s = 0;
  };
  /// Records `cycles` of the trace's gait and plays them.
  Way play(const std::string& trace, int cycles, unsigned seed) const {
    const std::string action = file("gait" + std::to_string(cycles) + ".action");
    const std::string program = VERP_PROGRAM;
    const std::string record = program + " action record " + trace + " -o " + action + " --gait " +
                               std::to_string(cycles) + " >/dev/null";
    EXPECT_EQ(std::system(record.c_str()), 0);
    const std::string told = file("told.json");
    const std::string play = program + " action play " + action + " --seed " +
                             std::to_string(seed) + " --json >" + told + " 2>/dev/null";
    EXPECT_EQ(std::system(play.c_str()), 0) << "it fell, or would not";
    std::ifstream in(told);
    const json result = json::parse(in, nullptr, false);
    if (!result.is_object()) return {};
    EXPECT_FALSE(result.at("fallen").get<bool>());
    return {std::hypot(result.at("ahead_m").get<double>(), result.at("left_m").get<double>()),
            result.at("action_s")};
  }

  fs::path folder_ =
      fs::path(::testing::TempDir()) / ("verp-paper-gait-" + std::to_string(getpid()));
};

class PaperGaitOfSeed : public PaperGait, public ::testing::WithParamInterface<unsigned> {};

TEST_P(PaperGaitOfSeed, OfSixteenStatesWalksForTenSecondsAsFastAsTheGaitItWasTakenFrom) {
  const unsigned seed = GetParam();
  const std::string trace = file("walk.mcap");
  const Walk walked = walk("generic21 --step 0.04 --cycle 0.45 --for 8 --seed " +
                           std::to_string(seed) + " --record " + trace);
  expect_walked(walked);
  // Subtracts start and end, which three cycles have too.
  const Way little = play(trace, 3, seed), much = play(trace, 26, seed);
  EXPECT_GT(much.s - little.s, 10);
  const double speed_m_s = (much.m - little.m) / (much.s - little.s);
  const double gait_m_s = number(walked, "speed_steady_m_s");
  expect_between(0.95 * gait_m_s, speed_m_s, 1.05 * gait_m_s, "m/s");
}
INSTANTIATE_TEST_SUITE_P(PaperGait, PaperGaitOfSeed, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace verp::scenario
