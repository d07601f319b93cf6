#include <gtest/gtest.h>
#include <linux/joystick.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fcntl.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "host/apps/view/run/gamepad.hpp"
#include "host/apps/view/run/linked.hpp"
#include "host/apps/view/run/live_run.hpp"
#include "host/apps/view/run/step_on.hpp"
#include "host/robot/model/params.hpp"
#include "host/show/scene/build.hpp"
#include "host/trace/record/ros_messages.hpp"
#include "tests/host/session/plans.hpp"
#include "tests/host/shadow/polled_controller.hpp"

namespace verp::view {
namespace {

using namespace std::chrono_literals;
using session::test::plan_of;

std::string place(const char* name) {
  return (std::filesystem::temp_directory_path() /
          ("verp-view-" + std::string(name) + "-" + std::to_string(::getpid())))
      .string();
}

template <class Met>
bool wait_for(Met met) {
  for (int i = 0; i < 4000 && !met(); ++i) std::this_thread::sleep_for(5ms);
  return met();
}

class Link : public testing::Test {
 protected:
  Link() : plan_(plan_of("dxl")), entity_(std::make_shared<model::Entity>(plan_.entity)) {}
  ~Link() override { std::filesystem::remove(path_); }

  std::unique_ptr<shadow::test::Controller> start() {
    return std::make_unique<shadow::test::Controller>(plan_.params, "unix-listen:" + path_, 8ms);
  }

  const std::string path_ = place("link");
  const session::WalkPlan plan_;
  const std::shared_ptr<const model::Entity> entity_;
};

TEST_F(Link, TheControllerAtTheOtherEndStandsBesideTheRobotWithItsOwnAngles) {
  auto controller = start();
  Linked linked("unix:" + path_, entity_, plan_.params);
  ASSERT_TRUE(wait_for([&] { return linked.told().looks > 3; })) << linked.told().trouble;
  const scene::RobotView own = scene::standing(*entity_);
  const scene::RobotView beside = linked.beside(own);
  ASSERT_EQ(beside.joint_rad.size(), plan_.params.joint_count);
  ASSERT_EQ(beside.goal_rad.size(), plan_.params.joint_count);
  ASSERT_EQ(beside.link_world.size(), own.link_world.size());
  EXPECT_NEAR((beside.link_world[0].translation() - own.link_world[0].translation()).y(), 0.45,
              0.01);
  bool other = false;
  for (std::size_t j = 0; j < beside.joint_rad.size(); ++j) {
    other = other || std::abs(beside.joint_rad[j] - own.joint_rad[j]) > 0.01;
  }
  EXPECT_TRUE(other) << "its inputs are out of a hat";
  EXPECT_GT(linked.told().digest, 0U);
}

TEST_F(Link, OneThatIsLostIsToldAndComesBack) {
  auto controller = start();
  Linked linked("unix:" + path_, entity_, plan_.params);
  ASSERT_TRUE(wait_for([&] { return linked.told().looks > 0; })) << linked.told().trouble;
  controller.reset();
  ASSERT_TRUE(wait_for([&] { return linked.told().lost; }));
  EXPECT_NE(linked.told().trouble, "");
  EXPECT_FALSE(linked.told().robot.joint_rad.empty()) << "it is shown as it was";
  controller = start();
  EXPECT_TRUE(wait_for([&] { return !linked.told().lost; })) << linked.told().trouble;
}

TEST_F(Link, DifferencesOfEachJointAreSignals) {
  auto controller = start();
  auto linked = std::make_shared<Linked>("unix:" + path_, entity_, plan_.params);
  ASSERT_TRUE(wait_for([&] { return linked->told().looks > 0; })) << linked->told().trouble;
  RunSetup setup{.run = {.plans = {plan_}}};
  setup.beside = [linked](const scene::RobotView& own) { return linked->beside(own); };
  LiveRun run(std::move(setup));
  run.set_speed(0);
  run.play();
  ASSERT_TRUE(wait_for([&] { return run.status().ticks > 20; })) << run.status().failure;
  const int number = signal_number(run.film()->all_signals(), "Linked joints/l_knee difference");
  ASSERT_GE(number, 0);
  std::vector<Point> points;
  run.film()->points(number, -1, points);
  ASSERT_GT(points.size(), 10U);
  EXPECT_TRUE(std::isfinite(points.back().value));
  ASSERT_EQ(run.film()->last()->robots.size(), 2U);
}

TEST(StepOn, HasTheRecordedBitsUntilANumberIsChanged) {
  const std::string file = place("step.mcap");
  LiveRun run({.run = {.plans = {plan_of("dxl")}}});
  run.set_speed(0);
  run.play();
  ASSERT_TRUE(wait_for([&] { return run.status().ticks > 300; })) << run.status().failure;
  run.pause();
  ASSERT_EQ(run.save(file), "");
  const scene::TracePlayer player(file);
  StepOn own(player, 200);
  EXPECT_TRUE(own.same_bits());
  own.on(1);
  EXPECT_EQ(own.index(), 201U);
  own.on(30);
  EXPECT_TRUE(own.same_bits());
  own.write(*model::tuning_id("gait.lift_m"), 0.02F);
  own.on(1);
  EXPECT_FALSE(own.same_bits());
  EXPECT_EQ(own.state().tuning.gait.lift_m, 0.02F);
  own.on(1'000'000);
  EXPECT_TRUE(own.ended());
  EXPECT_EQ(own.index(), player.size() - 1);
  std::filesystem::remove(file);
}

/// In place of the kernel's joystick.
class Stick : public testing::Test {
 protected:
  Stick() {
    ::mkfifo(path_.c_str(), 0600);
    writer_ = ::open(path_.c_str(), O_RDWR | O_NONBLOCK);
  }
  ~Stick() override {
    unplug();
    std::filesystem::remove(path_);
  }
  void unplug() {
    if (writer_ >= 0) ::close(writer_);
    writer_ = -1;
  }
  void send(int type, int number, int value) {
    js_event event{};
    event.type = static_cast<__u8>(type);
    event.number = static_cast<__u8>(number);
    event.value = static_cast<__s16>(value);
    ASSERT_EQ(::write(writer_, &event, sizeof event), ssize_t{sizeof event});
  }

  const std::string path_ = place("js");
  int writer_ = -1;
};

TEST_F(Stick, LeansAndItsButtonsAreHeardOnce) {
  Gamepad pad(path_);
  EXPECT_FALSE(pad.poll().came);
  send(JS_EVENT_AXIS | JS_EVENT_INIT, 1, -32767);
  EXPECT_TRUE(pad.poll().came);
  EXPECT_EQ(pad.sticks(), Sticks{}) << "how it lay when it was plugged in moves nobody";
  send(JS_EVENT_AXIS, 1, -32767);
  send(JS_EVENT_AXIS, 3, 16000);
  EXPECT_TRUE(pad.poll().moved);
  EXPECT_DOUBLE_EQ(pad.sticks().ahead, 1);
  EXPECT_LT(pad.sticks().turn, -0.3);
  send(JS_EVENT_AXIS, 0, 3000);
  EXPECT_FALSE(pad.poll().moved) << "a worn stick in its middle";
  send(JS_EVENT_BUTTON, 1, 1);
  EXPECT_TRUE(pad.poll().stop);
  EXPECT_FALSE(pad.poll().stop);
}

TEST_F(Stick, UnpluggedItHasLetGoOfAll) {
  Gamepad pad(path_);
  pad.poll();
  send(JS_EVENT_AXIS, 1, -32767);
  pad.poll();
  ASSERT_EQ(pad.sticks().ahead, 1);
  unplug();
  const Gamepad::News news = pad.poll();
  EXPECT_TRUE(news.went);
  EXPECT_TRUE(news.moved);
  EXPECT_EQ(pad.sticks(), Sticks{});
}

TEST(Stick_, ThatIsNotThereIsNoTrouble) {
  Gamepad pad("/nowhere/js0");
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(pad.poll().came);
  EXPECT_FALSE(pad.present());
}

}  // namespace
}  // namespace verp::view
