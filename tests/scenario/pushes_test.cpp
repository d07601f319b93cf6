#include <map>
#include <sstream>

#include "tests/scenario/walk.hpp"

// Pushed at the trunk for 50 ms, generic21 withstands 1.2 N s ahead and back and 0.8 N s sideways
// at any phase; these tests use four of 16 phases.
namespace verp::scenario {
namespace {

constexpr double kPush_s = 0.05, kCycle_s = 0.45, kFirst_s = 2.5;

void expect_walks_on(double ahead_n_s, double left_n_s) {
  for (const int phase : {0, 5, 10, 15}) {
    std::ostringstream push;
    push << kFirst_s + kCycle_s * phase / 16 << ": trunk " << ahead_n_s / kPush_s << ','
         << left_n_s / kPush_s << ",0 N for " << kPush_s;
    const Walk pushed = walk("generic21 --for 6 --physics-step 2 --push '" + push.str() + "'");
    SCOPED_TRACE(push.str());
    expect_walked(pushed);
  }
}

TEST(Pushed, AheadItWalksOn) {
  expect_walks_on(1.2, 0);
}

// Without such steps it falls at all phases.
TEST(Pushed, BackwardItWalksOn) {
  expect_walks_on(-1.2, 0);
}

TEST(Pushed, ToTheLeftItWalksOn) {
  expect_walks_on(0, 0.8);
}

TEST(Pushed, ToTheRightItWalksOn) {
  expect_walks_on(0, -0.8);
}

TEST(Pushed, BackwardItFallsWithoutFeedback) {
  const Walk pushed = walk(
      "generic21 --for 6 --physics-step 2 --no-feedback --push '2.5: trunk -24,0,0 N for 0.05'");
  EXPECT_EQ(pushed.result.value("fallen", false), true);
}

// It is pushed as hard as while walking, then stands again.
std::map<double, double> hardest_where_it_stands(const std::string& how) {
  const Walk map = walk("generic21 --map stand --map-grid 4 --physics-step 2" + how);
  EXPECT_EQ(map.status, 0);
  std::map<double, double> hardest_n_s;
  for (const json& side : map.result.value("sides", json::array())) {
    hardest_n_s[side.at("direction_deg")] = side.at("weakest_n_s");
  }
  EXPECT_EQ(hardest_n_s.size(), 4u);
  return hardest_n_s;
}

TEST(PushedWhereItStands, FromAllSidesItStandsAgain) {
  std::map<double, double> hardest_n_s = hardest_where_it_stands("");
  EXPECT_GE(hardest_n_s[0], 1.2) << "ahead";
  EXPECT_GE(hardest_n_s[180], 1.2) << "backward";
  EXPECT_GE(hardest_n_s[90], 0.8) << "to the left";
  EXPECT_GE(hardest_n_s[-90], 0.8) << "to the right";
}

// Its soles hold it only as far as they reach.
TEST(PushedWhereItStands, WithoutStepsItFallsEarlier) {
  std::map<double, double> hardest_n_s = hardest_where_it_stands(" --no-feedback");
  EXPECT_LT(hardest_n_s[0], 1.2) << "ahead";
  EXPECT_LT(hardest_n_s[180], 1.2) << "backward";
}

}  // namespace
}  // namespace verp::scenario
