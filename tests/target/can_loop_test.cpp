#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "host/can/virtual_can.hpp"
#include "host/sim/robot.hpp"
#include "host/sim/world.hpp"
#include "tests/target/can_run.hpp"

// The control loop in the board, its drives in the twin, and between them CAN frames on vcan0: run
// it inside of tests/support/with-can. VERP_TEST_BOARD names the board, VERP_TEST_TICKS the length.
namespace verp::board {
namespace {

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// generic21 with its CAN bus, on its feet in a world of its own.
struct CanTwin {
  test::Robot robot = test::load_robot("generic21", "can");
  sim::World world;
  sim::TwinRobot body{world, robot.entity};
  can::VirtualCan bus{robot.params, body};
};

constexpr double kStanding_s = 9;     ///< getting up and standing still at the end (twin_run.cpp)
constexpr double kLeast_m_s = 0.089;  ///< half of what the operator asks for

std::vector<TickRecord> walk_here(std::uint32_t ticks) {
  CanTwin twin;
  const sim::Vec3 start_m = twin.body.truth().com_world_m;
  std::vector<TickRecord> records = test::run_can_here(twin.robot.params, twin.bus, ticks);
  const double walking_s = 1e-6 * ticks * twin.robot.params.period_us - kStanding_s;
  const double walked_m = (twin.body.truth().com_world_m - start_m).head<2>().norm();
  EXPECT_FALSE(twin.body.truth().fallen);
  EXPECT_GE(walking_s, 2.0 - 1e-9);
  EXPECT_GT(walked_m, kLeast_m_s * walking_s);
  std::printf("walked %.2f m in %.1f s\n", walked_m, walking_s);
  return records;
}

/// What `verp shadow` finds that listens meanwhile: it asks for a State first.
void expect_same_bits_live(const shadow::LiveCheck& check, std::uint32_t ticks) {
  constexpr std::uint32_t kFirstState = 200;
  EXPECT_FALSE(check.over()) << (check.differs() ? "not the same bits" : check.refusal());
  EXPECT_EQ(check.unsettled(), 0u);
  EXPECT_EQ(check.gaps(), 0u) << check.gap();
  EXPECT_GE(check.compared() + kFirstState, ticks) << "what the board tells of its ticks";
}

// Digests of every stage in every tick, and the inputs they come from; and those that the board
// tells on the bus while it walks.
TEST(CanLoop, WalksInTheTwinWithTheBitsOfSoftwareInTheLoop) {
  const std::string board = setting("VERP_TEST_BOARD"), length = setting("VERP_TEST_TICKS");
  ASSERT_FALSE(board.empty() || length.empty()) << "set VERP_TEST_BOARD and VERP_TEST_TICKS";
  const auto ticks = static_cast<std::uint32_t>(std::stoul(length));
  const std::vector<TickRecord> here = walk_here(ticks);
  ASSERT_EQ(here.size(), ticks);
  CanTwin twin;
  shadow::LiveCheck check(twin.robot.params);
  const test::CanRun run = test::run_over_can(board, twin.robot.params, twin.bus, ticks, &check);
  std::printf("%-10s %u ticks at %.0f ticks/s with physics, %u answers asked for again\n",
              board.c_str(), ticks, run.ticks_per_s, run.counters.repeats);
  const std::vector<TickRecord>& there = run.records;
  ASSERT_EQ(there.size(), here.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    for (int stage = 0; stage < kStages; ++stage) {
      ASSERT_EQ(there[i].digest.stage[stage], here[i].digest.stage[stage])
          << "first divergence: tick " << i << ", stage " << kStageNames[stage];
    }
    ASSERT_EQ(std::memcmp(&there[i], &here[i], sizeof(TickRecord)), 0) << "tick " << i;
  }
  expect_same_bits_live(check, ticks);
}

}  // namespace
}  // namespace verp::board
