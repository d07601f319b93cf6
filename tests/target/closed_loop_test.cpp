#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/target/twin_run.hpp"

namespace verp::test {
namespace {

void expect_same(const TwinRun& here, const TwinRun& there) {
  ASSERT_EQ(here.records.size(), there.records.size());
  for (std::size_t i = 0; i < here.records.size(); ++i) {
    const TickDigest& a = here.records[i].digest;
    const TickDigest& b = there.records[i].digest;
    for (int stage = 0; stage < kStages; ++stage) {
      ASSERT_EQ(a.stage[stage], b.stage[stage])
          << "first divergence: tick " << i << ", stage " << kStageNames[stage];
    }
    ASSERT_EQ(a.chain, b.chain) << "tick " << i;
  }
}

// 20 s of walking, generic21 at 10 ms a tick.
TEST(ClosedLoop, WalksTheSameBitsInTheBoardAndOnThePc) {
  const char* board = std::getenv("VERP_TEST_BOARD");
  ASSERT_NE(board, nullptr) << "set VERP_TEST_BOARD";
  constexpr std::uint32_t kTicks = 2900;
  const Robot robot = load_robot("generic21");
  const TwinRun here = run_here(robot, kTicks, false);
  ASSERT_EQ(here.records.size(), kTicks);
  const TwinRun there = run_on_board(board, robot, walk_script(robot.params, kTicks));
  expect_same(here, there);
  EXPECT_EQ(here.distance_m, there.distance_m);
  EXPECT_FALSE(there.fallen);
  EXPECT_GT(there.distance_m, 2.0) << "it should have walked";
}

TEST(ClosedLoop, WalksTheSameBitsOnFeetechServos) {
  const char* board = std::getenv("VERP_TEST_BOARD");
  ASSERT_NE(board, nullptr) << "set VERP_TEST_BOARD";
  constexpr std::uint32_t kTicks = 850;
  const Robot robot = load_robot("generic21", "feetech");
  ASSERT_EQ(robot.params.bus_protocol, BusProtocol::kFeetech);
  const TwinRun here = run_here(robot, kTicks, false);
  ASSERT_EQ(here.records.size(), kTicks);
  const TwinRun there = run_on_board(board, robot, walk_script(robot.params, kTicks));
  expect_same(here, there);
  EXPECT_FALSE(there.fallen);
  EXPECT_GT(there.distance_m, 0.2) << "it should have walked";
}

TEST(Tour, HasTheSameBitsInTheBoardAndOnThePc) {
  const char* board = std::getenv("VERP_TEST_BOARD");
  ASSERT_NE(board, nullptr) << "set VERP_TEST_BOARD";
  const Robot robot = load_robot("generic21");
  const Script tour = tour_script(robot);
  const TwinRun here = run_here(robot, tour);
  EXPECT_TRUE(std::ranges::equal(here.modes, kTourModes)) << modes_text(here.modes);
  ASSERT_EQ(here.pushed_m.size(), 2u);
  EXPECT_GT(here.pushed_m[1], 0.3) << "it should have walked before it was pushed over";
  expect_same(here, run_on_board(board, robot, tour));
}

}  // namespace
}  // namespace verp::test
