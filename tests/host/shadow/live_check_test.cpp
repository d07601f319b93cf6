#include "host/run/shadow/live_check.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "tests/host/shadow/watched_robot.hpp"

namespace verp::shadow::test {
namespace {

using Check = LiveCheck::State;
constexpr unsigned kSeeds = 20;  // of 1,000 ticks

TEST(LiveCheck, FollowsARunningControllerTickByTick) {
  WatchedRobot<> robot(can_robot());
  robot.run(999);
  const std::uint64_t digest = robot.controller->loop.state().digest.chain;
  robot.run(1);  // a report comes by the next tick
  EXPECT_EQ(robot.check().state(), Check::kFollowing) << robot.check().refusal();
  EXPECT_GT(robot.check().compared(), 900u);
  EXPECT_EQ(robot.check().gaps(), 0u) << robot.check().gap();
  EXPECT_EQ(robot.check().digest(), digest);
  EXPECT_NE(robot.controller->loop.outputs().torque_enable, 0u) << "it stands, or walks";
}

TEST(LiveCheck, SendsNothingWhileItFollows) {
  WatchedRobot<> robot(can_robot());
  robot.run(200);
  ASSERT_EQ(robot.check().state(), Check::kFollowing);
  const unsigned sent = robot.ear->sent;
  robot.run(300);
  EXPECT_EQ(robot.ear->sent, sent);
}

// Late frames carry other values.
TEST(LiveCheck, RaisesNoFalseAlarmForLostAndLateFrames) {
  std::uint64_t compared = 0, gaps = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    WatchedRobot<> robot(can_robot());
    auto late_node = std::make_unique<LateTwin>(std::uint8_t{3}, seed);
    const LateTwin& late = *late_node;
    robot.twin.plug_in(std::move(late_node));
    robot.bus.seed(seed + 100);
    robot.ear->seed(seed + 200);
    robot.bus.lost_per_mille = 20;
    robot.ear->lost_per_10000 = 1 + seed % 4;
    robot.run(1000);
    ASSERT_FALSE(robot.check().differs())
        << seed << ": "
        << record::text(robot.check().divergence(), robot.params, "controller", "PC");
    EXPECT_LE(robot.check().unsettled(), robot.check().gaps()) << seed;
    EXPECT_GT(robot.bus.lost, 100u);
    EXPECT_GT(late.said, 100u);
    compared += robot.check().compared();
    gaps += robot.check().gaps();
  }
  EXPECT_GT(compared, 400u * kSeeds);
  EXPECT_GT(gaps, kSeeds) << "this PC missed some, and says so";
}

// State has 2.9 KB; the check asks once more for lost answers.
TEST(LiveCheck, LateAndLostAnswersAloneLeaveNoTickOut) {
  constexpr int kTicks = 1000;
  std::uint64_t compared = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    WatchedRobot<> robot(can_robot());
    robot.twin.plug_in(std::make_unique<LateTwin>(std::uint8_t{3}, seed));
    robot.bus.seed(seed);
    robot.bus.lost_per_mille = 20;
    int before = 0;
    while (robot.check().compared() == 0 && before < kTicks) robot.run(1), ++before;
    robot.run(kTicks - before);
    EXPECT_EQ(robot.check().state(), Check::kFollowing) << seed;
    EXPECT_EQ(robot.check().gaps(), 0u) << seed << ": " << robot.check().gap();
    EXPECT_EQ(robot.check().unsettled(), 0u) << seed;
    EXPECT_GE(static_cast<int>(robot.check().compared()) + before, kTicks) << seed;
    compared += robot.check().compared();
  }
  EXPECT_GT(compared, 600u * kSeeds);
}

template <class Field>
std::uint32_t flip(WatchedRobot<>& robot, Field& field) {
  robot.run(200);
  EXPECT_EQ(robot.check().state(), Check::kFollowing);
  std::uint32_t bits;
  std::memcpy(&bits, &field, sizeof bits);
  bits ^= 1;
  std::memcpy(&field, &bits, sizeof bits);
  const std::uint32_t tick = robot.controller->loop.inputs().tick + 1;
  robot.run(300);
  return tick;
}

void expect_found(WatchedRobot<>& robot, std::uint32_t tick, const char* stage, const char* field) {
  ASSERT_EQ(robot.check().state(), Check::kDiffers);
  const record::Divergence& found = robot.check().divergence();
  EXPECT_EQ(found.tick, tick);
  EXPECT_EQ(found.stage, stage);
  ASSERT_FALSE(found.fields.empty());
  EXPECT_EQ(found.fields[0].path, field);
  EXPECT_EQ(found.fields_tick, tick) << "the order to hold came before the next tick's end";
}

TEST(LiveCheck, FindsABitOfTheTuning) {
  WatchedRobot<> robot(can_robot());
  const std::uint32_t tick = flip(robot, robot.state().tuning.balance.ankle_pitch_tilt);
  expect_found(robot, tick, "admit", "tuning.balance.ankle_pitch_tilt");
}

TEST(LiveCheck, FindsABitOfTheGait) {
  WatchedRobot<> robot(can_robot());
  const std::uint32_t tick = flip(robot, robot.state().zeros.leg[1].pitch_rad);
  expect_found(robot, tick, "kinematics", "zeros.leg[1].pitch_rad");
}

TEST(LiveCheck, TheControllerTicksOnWhileItIsRead) {
  WatchedRobot<> robot(can_robot());
  const std::uint32_t tick = flip(robot, robot.state().zeros.leg[0].roll_rad);
  ASSERT_EQ(robot.check().state(), Check::kDiffers);
  EXPECT_GT(robot.controller->loop.inputs().tick, tick + 10);
  EXPECT_EQ(robot.controller->registers.armed(),
            robot.controller->loop.outputs().torque_enable != 0);
}

TEST(LiveCheck, RefusesAnotherRobotInOneLine) {
  Params other = can_robot();
  other.joint[2].counts_per_rad += 1;
  WatchedRobot<> robot(can_robot(), other);
  robot.run(300);
  ASSERT_EQ(robot.check().state(), Check::kRefused);
  EXPECT_NE(robot.check().refusal().find("drives another robot"), std::string::npos);
  EXPECT_EQ(robot.check().refusal().find('\n'), std::string::npos);
}

TEST(LiveCheck, FollowsAControllerThatBeginsAnew) {
  WatchedRobot<> robot(can_robot());
  robot.run(300);
  const std::uint64_t before = robot.check().compared();
  robot.power_on();
  robot.run(500);
  EXPECT_EQ(robot.check().state(), Check::kFollowing);
  EXPECT_EQ(robot.check().boots(), 1u);
  EXPECT_GT(robot.check().compared(), before + 300);
}

TEST(LiveCheck, GoesOnAfterTheLinkWasGone) {
  WatchedRobot<> robot(can_robot());
  robot.run(300);
  robot.ear->cut = true;
  robot.run(200);
  robot.ear->cut = false;
  const std::uint64_t before = robot.check().compared();
  robot.run(400);
  EXPECT_EQ(robot.check().state(), Check::kFollowing);
  EXPECT_EQ(robot.check().gaps(), 1u) << robot.check().gap();
  EXPECT_GT(robot.check().compared(), before + 200);
}

struct CountingChip {
  hal::ImuStatus read(hal::ImuSample& sample) {
    ++reads;
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro_count[axis] = static_cast<std::int16_t>(reads * (axis + 1));
      sample.accel_count[axis] = static_cast<std::int16_t>(4096 - reads * axis);
    }
    return reads % 7 == 0 ? hal::ImuStatus::kStale : hal::ImuStatus::kFresh;
  }
  std::uint32_t faults() const { return 0; }
  int reads = 0;
};

TEST(LiveCheck, KnowsTheCountsOfTheControllersOwnImu) {
  Params params = can_robot();
  params.imu.device_id = 0;
  CountingChip chip;
  WatchedRobot<CountingChip> robot(params, &chip);
  robot.run(500);
  EXPECT_EQ(robot.check().state(), Check::kFollowing) << robot.check().refusal();
  EXPECT_GT(robot.check().compared(), 400u);
  EXPECT_EQ(robot.check().gaps(), 0u) << robot.check().gap();
}

}  // namespace
}  // namespace verp::shadow::test
