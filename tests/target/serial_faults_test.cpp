#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/target/serial_board.hpp"

// In lockstep over a faulty cable. VERP_TEST_BOARD and VERP_TEST_TICKS as in serial_loop_test.cpp.
namespace verp::test {
namespace {

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

class SerialFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(setting("VERP_TEST_TICKS").empty()) << "set VERP_TEST_BOARD and VERP_TEST_TICKS";
    ticks = static_cast<std::uint32_t>(std::stoul(setting("VERP_TEST_TICKS")));
    robot = load_robot("generic21");
  }
  SerialRun run(const SerialTrouble& trouble) const {
    SerialBoard board(setting("VERP_TEST_BOARD"), params_image(robot));
    EXPECT_TRUE(board.operator_port().ping(dxl::controller::kDefaultId).has_value());
    const SerialRun there = run_over_serial(board, robot, ticks, trouble);
    std::printf("%llu faults, %d cuts: %u asked again, %u damaged, %u timeouts on the bus\n",
                static_cast<unsigned long long>(there.faults), there.cuts, there.lockstep.repeats,
                there.lockstep.damaged, there.bus_timeouts);
    return there;
  }
  void expect_known(const SerialRun& there) const {
    EXPECT_EQ(there.difference, "");
    ASSERT_EQ(there.twin.records.size(), ticks);
    EXPECT_EQ(there.digest, there.twin.records.back().digest.chain) << "as the controller tells it";
    EXPECT_EQ(there.tick, there.twin.records.back().inputs.tick);
    EXPECT_EQ(there.lockstep.greetings, 1u);
  }
  void expect_same_as_here(const SerialRun& there) const {
    expect_known(there);
    const TwinRun here = run_here(robot, ticks, false);
    EXPECT_EQ(there.digest, here.records.back().digest.chain);
    EXPECT_EQ(there.twin.distance_m, here.distance_m);
    EXPECT_EQ(there.bus_timeouts, 0u);
  }

  static constexpr std::uint32_t kStandsUp = 500;
  std::uint32_t ticks = 0;
  Robot robot;
};

TEST_F(SerialFaults, LoseNoBitOnTheWayToTheController) {
  constexpr LinkFaults kBad{.lost = 2e-4, .doubled = 2e-4, .flipped = 2e-4};
  ticks = kStandsUp;
  const SerialRun there = run({.to_board = kBad, .from_board = {}, .seed = 1});
  expect_same_as_here(there);
  EXPECT_GT(there.faults, 100u);
  EXPECT_GT(there.lockstep.repeats, 50u);
  EXPECT_EQ(there.lockstep.damaged, 0u);
}

TEST_F(SerialFaults, LoseNoBitWhenTheCableIsPulledAndPutBack) {
  ticks = kStandsUp;
  const SerialRun there = run({.to_board = {}, .from_board = {}, .cut_every = 400, .seed = 2});
  expect_same_as_here(there);
  EXPECT_GT(there.cuts, 1);
  EXPECT_GE(there.lockstep.repeats, static_cast<std::uint32_t>(there.cuts));
}

// The bytes are the bus itself: a lost one is lost for good.
TEST_F(SerialFaults, LetItWalkOnWithOneByteInAThousandLost) {
  const SerialRun there =
      run({.to_board = {.lost = 1e-3}, .from_board = {.lost = 1e-3}, .seed = 3});
  expect_known(there);
  EXPECT_GT(there.lockstep.damaged, 50u);
  EXPECT_GT(there.bus_timeouts, 20u) << "the operator sees it";
  EXPECT_FALSE(there.twin.fallen);
  const TwinRun here = run_here(robot, ticks, false);
  EXPECT_GT(here.distance_m, 0.2) << "the bar is a walk";
  EXPECT_NEAR(there.twin.distance_m, here.distance_m, 0.1 * here.distance_m);
}

// Three bytes in a thousand, both ways.
TEST_F(SerialFaults, EndInOrderOnALineFullOfNoise) {
  constexpr LinkFaults kAwful{.lost = 1e-3, .doubled = 1e-3, .flipped = 1e-3};
  ticks = 150;
  const SerialRun there = run({.to_board = kAwful, .from_board = kAwful, .seed = 4});
  expect_known(there);
  EXPECT_GT(there.bus_timeouts, 20u);
  EXPECT_GT(there.lockstep.damaged, 40u);
}

}  // namespace
}  // namespace verp::test
