#include "host/run/shadow/polled_check.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <unistd.h>

#include "host/os/link/system_clock.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/shadow/polled_controller.hpp"

namespace verp::shadow::test {
namespace {

std::string place(const std::string& name) {
  return (std::filesystem::temp_directory_path() /
          ("verp-shadow-" + name + "-" + std::to_string(::getpid())))
      .string();
}

class Polled : public ::testing::Test {
 protected:
  explicit Polled()
      : path_(place(::testing::UnitTest::GetInstance()->current_test_info()->name())) {}
  ~Polled() override { std::filesystem::remove(path_); }

  void start(const Params& listens_for, std::chrono::milliseconds period) {
    const Params params = verp::test::bus_params(7);
    controller = std::make_unique<Controller>(params, "unix-listen:" + path_, period);
    listens_for_ = listens_for;
    port = std::make_unique<TickPort>(link::parse_endpoint("unix:" + path_));
    check = std::make_unique<PolledCheck>(listens_for_, *port);
  }
  /// Until `compared` ticks, the check's end, or 20 s.
  void run(std::uint64_t compared) {
    const std::uint64_t end_ns = link::monotonic_ns() + 20'000'000'000;
    while (check->compared() < compared && !check->over() && link::monotonic_ns() < end_ns) {
      const std::uint64_t now_us = link::monotonic_ns() / 1000;
      if (!check->turn(now_us)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  const std::string path_;
  Params listens_for_;
  std::unique_ptr<Controller> controller;
  std::unique_ptr<TickPort> port;
  std::unique_ptr<PolledCheck> check;
};

TEST_F(Polled, FollowsAControllerTickByTickOverSkippedPeriodsToo) {
  start(verp::test::bus_params(7), std::chrono::milliseconds(5));
  run(300);
  EXPECT_EQ(check->state(), PolledCheck::State::kFollowing) << check->refusal();
  EXPECT_GE(check->compared(), 300u);
  EXPECT_FALSE(check->differs());
}

TEST_F(Polled, FindsABitThatFlipped) {
  start(verp::test::bus_params(7), std::chrono::milliseconds(5));
  run(50);
  ASSERT_EQ(check->state(), PolledCheck::State::kFollowing) << check->refusal();
  const std::uint32_t tick = (controller->tick / 51 + 1) * 51 + 20;  // not a skipped tick
  controller->spoil_at = tick;
  run(2000);
  ASSERT_TRUE(check->differs());
  EXPECT_EQ(check->divergence().tick, tick);
  EXPECT_EQ(check->divergence().stage, "kinematics");
  ASSERT_FALSE(check->divergence().fields.empty());
  EXPECT_EQ(check->divergence().fields[0].path, "zeros.leg[1].pitch_rad");
}

TEST_F(Polled, SaysWhichTicksItLostAndGoesOn) {
  start(verp::test::bus_params(7), std::chrono::milliseconds(5));
  run(50);
  const std::uint32_t before = controller->tick;
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  EXPECT_GT(controller->tick, before + Log::kTicks) << "it went on";
  run(check->compared() + 50);
  EXPECT_GE(check->gaps(), 1u);
  EXPECT_NE(check->gap().find("dropped"), std::string::npos) << check->gap();
  EXPECT_FALSE(check->over());
}

TEST_F(Polled, FollowsAControllerThatBeginsAnew) {
  start(verp::test::bus_params(7), std::chrono::milliseconds(5));
  run(100);
  controller->restart = true;
  run(check->compared() + 100);
  EXPECT_EQ(check->boots(), 1u);
  EXPECT_FALSE(check->over()) << check->refusal();
}

TEST_F(Polled, RefusesAnotherRobotInOneLine) {
  Params other = verp::test::bus_params(7);
  other.joint[2].counts_per_rad += 1;
  start(other, std::chrono::milliseconds(5));
  run(1);
  ASSERT_EQ(check->state(), PolledCheck::State::kRefused);
  EXPECT_NE(check->refusal().find("drives another robot"), std::string::npos);
}

}  // namespace
}  // namespace verp::shadow::test
