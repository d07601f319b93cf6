#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "host/os/link/can_port.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "host/twin/sim/robot.hpp"
#include "host/twin/sim/world.hpp"
#include "tests/target/can_run.hpp"

// Run it inside tests/support/with-can. VERP_TEST_BOARD names the board, VERP_TEST_TICKS the
// length.
namespace verp::board {
namespace {

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

using test::CanTwin;

constexpr double kStanding_s = 5.5;   ///< before and after the walk (twin_run.cpp)
constexpr double kLeast_m_s = 0.089;  ///< half of the order

std::vector<TickRecord> walk_here(std::uint32_t ticks) {
  CanTwin twin;
  const sim::Vec3 start_m = twin.body.truth().com_world_m;
  std::vector<TickRecord> records =
      test::run_can_here(twin, test::walk_script(twin.robot.params, ticks));
  const double walking_s = 1e-6 * ticks * twin.robot.params.period_us - kStanding_s;
  const double walked_m = (twin.body.truth().com_world_m - start_m).head<2>().norm();
  EXPECT_FALSE(twin.body.truth().fallen);
  EXPECT_GE(walking_s, 2.0 - 1e-9);
  EXPECT_GT(walked_m, kLeast_m_s * walking_s);
  std::printf("walked %.2f m in %.1f s\n", walked_m, walking_s);
  return records;
}

void expect_same(const std::vector<TickRecord>& here, const std::vector<TickRecord>& there) {
  ASSERT_EQ(there.size(), here.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    for (int stage = 0; stage < kStages; ++stage) {
      ASSERT_EQ(there[i].digest.stage[stage], here[i].digest.stage[stage])
          << "first divergence: tick " << i << ", stage " << kStageNames[stage];
    }
    ASSERT_EQ(std::memcmp(&there[i], &here[i], sizeof(TickRecord)), 0) << "tick " << i;
  }
}

/// `verp shadow` listens; it first asks for a State.
void expect_same_bits_live(const shadow::LiveCheck& check, std::uint32_t ticks) {
  constexpr std::uint32_t kFirstState = 200;
  EXPECT_FALSE(check.over()) << (check.differs() ? "not the same bits" : check.refusal());
  EXPECT_EQ(check.unsettled(), 0u);
  EXPECT_EQ(check.gaps(), 0u) << check.gap();
  EXPECT_GE(check.compared() + kFirstState, ticks) << "what the board tells of its ticks";
}

TEST(CanLoop, WalksInTheTwinWithTheBitsOfSoftwareInTheLoop) {
  const std::string board = setting("VERP_TEST_BOARD"), length = setting("VERP_TEST_TICKS");
  ASSERT_FALSE(board.empty() || length.empty()) << "set VERP_TEST_BOARD and VERP_TEST_TICKS";
  const auto ticks = static_cast<std::uint32_t>(std::stoul(length));
  const std::vector<TickRecord> here = walk_here(ticks);
  ASSERT_EQ(here.size(), ticks);
  CanTwin twin;
  shadow::LiveCheck check(twin.robot.params);
  const test::CanRun run =
      test::run_over_can(board, twin, test::walk_script(twin.robot.params, ticks), &check);
  std::printf("%-10s %u ticks at %.0f ticks/s with physics, %u answers asked for again\n",
              board.c_str(), ticks, run.ticks_per_s, run.counters.repeats);
  expect_same(here, run.records);
  expect_same_bits_live(check, ticks);
}

TEST(CanTour, HasTheBitsOfSoftwareInTheLoop) {
  const std::string board = setting("VERP_TEST_BOARD");
  ASSERT_FALSE(board.empty()) << "set VERP_TEST_BOARD";
  CanTwin here, there;
  const test::Script tour = test::tour_script(here.robot);
  const std::vector<TickRecord> records = test::run_can_here(here, tour);
  EXPECT_EQ(records.size(), tour.ticks);
  EXPECT_TRUE(here.body.truth().fallen) << "it fell, and";
  EXPECT_TRUE(here.body.forget_fall()) << "got up";
  const test::CanRun run = test::run_over_can(board, there, tour);
  std::printf("%-10s %u ticks at %.0f ticks/s with physics\n", board.c_str(), tour.ticks,
              run.ticks_per_s);
  expect_same(records, run.records);
}

/// Asks the board's node for its mode without pause, and sometimes to relax.
class Poller {
 public:
  ~Poller() { end(); }
  void end() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  std::atomic<unsigned> told{0}, refused{0}, others{0};

 private:
  static CanFrame request(const std::array<std::uint8_t, 8>& bytes) {
    CanFrame frame;
    frame.id = 0x67F;
    frame.size = 8;
    std::copy(bytes.begin(), bytes.end(), frame.data);
    return frame;
  }
  void run() {
    constexpr std::uint32_t kPatience_us = 20'000;
    link::CanPort port({.kind = link::Endpoint::Kind::kCan, .place = "vcan0"}, {{0x5FF, 0x7FF}});
    CanFrame frame;
    for (unsigned n = 0; !over_; ++n) {
      port.send(n % 8 == 7 ? request({0x2F, 0x50, 0x20, 0, 0, 0, 0, 0})
                           : request({0x40, 0x90, 0x20, 0, 0, 0, 0, 0}));
      if (!port.await(frame, kPatience_us)) continue;
      const bool local_control = frame.data[0] == 0x80 && frame.data[4] == 0x21;
      ++(frame.data[0] == 0x4F ? told : local_control ? refused : others);
    }
  }

  std::atomic<bool> over_{false};
  std::thread thread_{[this] { run(); }};
};

// Foreign frames would overflow the board's small FIFO, and it would not obey an order that it
// accepted.
TEST(CanLoop, IsNeitherEndedNorOrderedByWhoPollsItsNode) {
  const std::string board = setting("VERP_TEST_BOARD");
  ASSERT_FALSE(board.empty()) << "set VERP_TEST_BOARD";
  constexpr std::uint32_t kTicks = 100;
  CanTwin here, twin;
  const auto expected = test::run_can_here(here, test::walk_script(here.robot.params, kTicks));
  Poller poller;
  const test::CanRun run =
      test::run_over_can(board, twin, test::walk_script(twin.robot.params, kTicks));
  poller.end();
  ASSERT_EQ(run.records.size(), kTicks);
  EXPECT_EQ(run.records.back().digest.chain, expected.back().digest.chain);
  EXPECT_GT(poller.told, 10u);
  EXPECT_GT(poller.refused, 1u);
  EXPECT_EQ(poller.others, 0u);
}

}  // namespace
}  // namespace verp::board
