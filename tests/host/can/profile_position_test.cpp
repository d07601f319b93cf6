#include <gtest/gtest.h>

#include <algorithm>

#include "host/twin/can/positioning.hpp"
#include "tests/host/can/virtual_drive.hpp"

namespace verp {
namespace {

using canopen::Abort;
using canopen::cia402::State;
using test::kNode;
namespace cia402 = canopen::cia402;
namespace object = canopen::cia402::object;
namespace profile_at = can::profile_at;

constexpr std::uint16_t kEnabled = cia402::kWordEnableOperation;
constexpr std::int32_t kStart = 8192;

class ProfileDrive : public test::VirtualDrive {
 protected:
  /// 1 increment each ms, reached in 100 ms and left in 200 ms.
  ProfileDrive() {
    bench.enable(kNode);
    EXPECT_EQ(mode(can::kModeProfilePosition), Abort::kNone);
    set(profile_at::kVelocity, 1000);
    set(profile_at::kAcceleration, 10'000);
    set(profile_at::kDeceleration, 5000);
  }
  void set(canopen::Address at, std::int64_t value) {
    EXPECT_EQ(bench.write(kNode, at, value, 4), Abort::kNone) << std::hex << at.index;
  }
  Abort mode(std::int8_t wanted) { return bench.write(kNode, object::kMode, wanted, 1); }
  void word(unsigned bits) {
    bench.write(kNode, object::kControlword, kEnabled | static_cast<int>(bits), 2);
    run(1);
  }
  void go(std::int32_t to, unsigned bits = 0) {
    target(to);
    word(can::kBitStart | bits);
  }
  /// As a master does: the edge, then the bit back.
  void go_and_release(std::int32_t to, unsigned bits = 0) {
    go(to, bits);
    word(0);
  }
  bool has(std::uint16_t bit) { return (status() & bit) != 0; }
  std::int32_t goal() { return bench.setpoint(0).goal_count; }
  void run(int time_ms) { bench.let_pass(static_cast<std::uint64_t>(time_ms) * 1000); }
};

TEST_F(ProfileDrive, TakesASetPointAndTellsWhenItIsReached) {
  EXPECT_TRUE(has(can::kTargetReached)) << "it stands where it should";
  EXPECT_FALSE(has(can::kSetPointTaken));
  go(kStart + 500);
  EXPECT_TRUE(has(can::kSetPointTaken));
  EXPECT_FALSE(has(can::kTargetReached));
  word(0);
  EXPECT_FALSE(has(can::kSetPointTaken)) << "free for the next one";
  target(kStart - 999);
  run(640);
  EXPECT_FALSE(has(can::kTargetReached));
  run(40);
  EXPECT_TRUE(has(can::kTargetReached));
  EXPECT_EQ(goal(), kStart + 500) << "a target without an edge is no set-point";
}

// 50 ms and 100 ms of a ramp are worth half of their time: 500 + 50 + 100.
TEST_F(ProfileDrive, RampsUpAndDownWithinItsVelocity) {
  go_and_release(kStart + 500);
  std::int32_t before = goal(), top = 0, at_50_ms = 0, at_600_ms = 0;
  for (int ms = 1; ms <= 700; ++ms) {
    run(1);
    const std::int32_t step = goal() - before;
    EXPECT_GE(step, 0);
    top = std::max(top, step);
    before = goal();
    if (ms == 50) at_50_ms = goal() - kStart;
    if (ms == 600) at_600_ms = kStart + 500 - goal();
  }
  EXPECT_LE(top, 2) << "1 increment a ms, rounded";
  EXPECT_NEAR(at_50_ms, 12.5, 3);
  EXPECT_NEAR(at_600_ms, 6.2, 3);
  EXPECT_EQ(goal(), kStart + 500);
  EXPECT_EQ(bench.setpoint(0).profile_ms, 1u) << "the servo joins the ramp's steps";
}

TEST_F(ProfileDrive, KeepsToTheMaxProfileVelocity) {
  set(profile_at::kMaxVelocity, 100);
  go_and_release(kStart + 500);
  run(1000);
  EXPECT_NEAR(goal() - kStart, 100, 5);
}

TEST_F(ProfileDrive, ASetPointWaitsForTheOneUnderWay) {
  go_and_release(kStart + 100);
  go_and_release(kStart);
  EXPECT_TRUE(has(can::kSetPointTaken)) << "there is room for one";
  go_and_release(kStart + 900);
  std::int32_t most = 0;
  for (int ms = 0; ms < 900; ++ms) {
    run(1);
    most = std::max(most, goal());
  }
  EXPECT_EQ(most, kStart + 100);
  EXPECT_EQ(goal(), kStart) << "the third one was not taken";
  EXPECT_FALSE(has(can::kSetPointTaken));
  EXPECT_TRUE(has(can::kTargetReached));
}

TEST_F(ProfileDrive, ASetPointAtOnceEndsTheOthers) {
  go_and_release(kStart + 500);
  go_and_release(kStart + 900);
  run(200);
  go_and_release(kStart, can::kBitAtOnce);
  EXPECT_FALSE(has(can::kSetPointTaken));
  std::int32_t most = 0;
  for (int ms = 0; ms < 900; ++ms) {
    run(1);
    most = std::max(most, goal());
  }
  EXPECT_NEAR(most - kStart, 150 + 100, 10) << "it brakes before it turns";
  EXPECT_EQ(goal(), kStart);
}

TEST_F(ProfileDrive, RelativeSetPointsCountFromTheOneBefore) {
  go_and_release(100, can::kBitRelative);
  go_and_release(-30, can::kBitRelative);
  run(900);
  EXPECT_EQ(goal(), kStart + 70);
  go_and_release(10, can::kBitRelative | can::kBitAtOnce);
  run(300);
  EXPECT_EQ(goal(), kStart + 80);
}

TEST_F(ProfileDrive, HaltBrakesAndGoesOnLater) {
  go_and_release(kStart + 500);
  run(300);
  word(can::kBitHalt);
  EXPECT_FALSE(has(can::kTargetReached)) << "it still moves";
  run(250);
  const std::int32_t stands = goal();
  EXPECT_NEAR(stands - kStart, 250 + 100, 10);
  EXPECT_TRUE(has(can::kTargetReached)) << "with halt it means: no speed";
  run(100);
  EXPECT_EQ(goal(), stands);
  word(0);
  EXPECT_FALSE(has(can::kTargetReached));
  run(900);
  EXPECT_EQ(goal(), kStart + 500);
}

TEST_F(ProfileDrive, CutsASetPointAtItsLimitsAndSaysSo) {
  set(object::kMaxPosition, kStart + 50);
  go_and_release(kStart + 500);
  EXPECT_TRUE(has(cia402::kInternalLimit));
  run(900);
  EXPECT_EQ(goal(), kStart + 50);
  EXPECT_TRUE(has(can::kTargetReached));
  go_and_release(kStart + 20);
  EXPECT_FALSE(has(cia402::kInternalLimit));
}

TEST_F(ProfileDrive, IsThereWhenItWasLongEnoughInItsWindow) {
  set(profile_at::kPositionWindow, 20);
  EXPECT_EQ(bench.write(kNode, profile_at::kPositionWindowTime, 50, 2), Abort::kNone);
  go_and_release(kStart + 100);
  bench.plant.blocked[0] = true;
  run(600);
  EXPECT_FALSE(has(can::kTargetReached)) << "the ramp ended, the joint is elsewhere";
  measured().position_count = kStart + 85;
  run(30);
  EXPECT_FALSE(has(can::kTargetReached));
  run(40);
  EXPECT_TRUE(has(can::kTargetReached));
  measured().position_count = kStart + 70;
  run(5);
  EXPECT_FALSE(has(can::kTargetReached)) << "pushed away";
}

TEST_F(ProfileDrive, ItsFollowingErrorIsAgainstTheRamp) {
  set(object::kFollowingWindow, 30);
  go_and_release(kStart + 500);
  EXPECT_TRUE(emergencies(300'000).empty()) << "far from its target, near the ramp";
  bench.plant.blocked[0] = true;
  const std::vector<canopen::Emergency> told = emergencies(100'000);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, 0x8611);
  EXPECT_TRUE(has(cia402::kFollowingError));
}

TEST_F(ProfileDrive, AChangeOfModeHoldsUntilTheNewModesTarget) {
  go_and_release(kStart + 500);
  run(300);
  const std::int32_t there = goal();
  EXPECT_EQ(mode(cia402::kModeCyclicPosition), Abort::kNone);
  EXPECT_EQ(bench.value(kNode, object::kModeDisplay), cia402::kModeCyclicPosition);
  run(50);
  EXPECT_NEAR(goal(), there, 2) << "no jump to the set-point";
  EXPECT_EQ(bench.state(kNode), State::kOperationEnabled);
  target(kStart + 300);
  EXPECT_EQ(goal(), kStart + 300);
  EXPECT_EQ(mode(can::kModeProfilePosition), Abort::kNone);
  target(kStart);
  run(500);
  EXPECT_EQ(goal(), kStart + 300);
  EXPECT_EQ(mode(cia402::kModeNone), Abort::kNone);
  run(5);
  EXPECT_EQ(goal(), kStart + 300);
}

TEST_F(ProfileDrive, SaysWhichModesItHasAndRefusesOthers) {
  EXPECT_EQ(bench.value(kNode, object::kSupportedModes), 0xA1) << "1, 6 and 8";
  for (const int other : {2, 3, 4, 7, 9, 10, -1}) {
    EXPECT_EQ(mode(static_cast<std::int8_t>(other)), Abort::kValueRange) << other;
  }
  EXPECT_EQ(bench.value(kNode, object::kModeDisplay), can::kModeProfilePosition);
}

TEST_F(ProfileDrive, RefusesRampsThatItCannotMake) {
  EXPECT_EQ(bench.write(kNode, profile_at::kAcceleration, 0, 4), Abort::kValueRange);
  EXPECT_EQ(bench.write(kNode, profile_at::kDeceleration, 0, 4), Abort::kValueRange);
  EXPECT_EQ(bench.write(kNode, profile_at::kProfileType, 1, 2), Abort::kValueRange) << "sin2";
  EXPECT_EQ(bench.write(kNode, profile_at::kProfileType, 0, 2), Abort::kNone);
}

TEST_F(ProfileDrive, ForgetsItsSetPointsWithItsTorqueAndTakesNoneWhileItIsEnabled) {
  go_and_release(kStart + 500);
  run(200);
  bench.control(kNode, cia402::kWordSwitchOn);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  EXPECT_FALSE(has(can::kSetPointTaken | can::kTargetReached)) << "of an operating drive only";
  measured().position_count = kStart + 20;
  go(kStart + 900);
  EXPECT_EQ(bench.state(kNode), State::kOperationEnabled);
  EXPECT_FALSE(has(can::kSetPointTaken)) << "this word began with the drive off";
  run(200);
  EXPECT_EQ(goal(), kStart + 20);
}

TEST_F(ProfileDrive, AQuickStopEndsTheRamp) {
  bench.write(kNode, object::kQuickStopOption, 6, 2);
  go_and_release(kStart + 500);
  run(300);
  bench.control(kNode, cia402::kWordQuickStop);
  const std::int32_t there = goal();
  bench.control(kNode, kEnabled);
  run(300);
  EXPECT_EQ(goal(), there);
  EXPECT_TRUE(has(can::kTargetReached));
}

TEST_F(ProfileDrive, ARampIsAsFastAsItsCommissioningSaysUntilItIsToldOtherwise) {
  bench.nmt(canopen::NmtCommand::kResetNode, kNode);
  EXPECT_EQ(bench.value(kNode, profile_at::kVelocity), 2608) << "1 rad/s";
  EXPECT_EQ(bench.value(kNode, profile_at::kAcceleration), 26076);
}

TEST_F(ProfileDrive, IsMovedByPdosAlone) {
  bench.write(kNode, {0x1400, 1}, 0x80000201, 4);
  bench.write(kNode, {0x1600, 0}, 0, 1);
  std::uint8_t entry = 0;
  for (const std::int64_t each : {0x60400010, 0x607A0020}) {
    EXPECT_EQ(bench.write(kNode, {0x1600, ++entry}, each, 4), Abort::kNone);
  }
  bench.write(kNode, {0x1600, 0}, 2, 1);
  bench.write(kNode, {0x1400, 1}, 0x201, 4);
  bench.nmt(canopen::NmtCommand::kStart, kNode);
  for (const std::uint16_t bits : {std::uint16_t{0}, can::kBitStart}) {
    CanFrame frame = canopen::classic_frame(canopen::rpdo_id(1, kNode), 6);
    canopen::put_le(frame.data, kEnabled | bits, 2);
    canopen::put_le(frame.data + 2, kStart + 40, 4);
    bench.bus.send(frame);
    run(2);
  }
  run(500);
  EXPECT_EQ(goal(), kStart + 40) << "the word stands before its target in the frame";
}

}  // namespace
}  // namespace verp
