#include <gtest/gtest.h>

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

class HomingDrive : public test::VirtualDrive {
 protected:
  HomingDrive() {
    bench.enable(kNode);
    EXPECT_EQ(bench.write(kNode, object::kMode, can::kModeHoming, 1), Abort::kNone);
  }
  Abort method(int number) { return bench.write(kNode, profile_at::kHomingMethod, number, 1); }
  void word(unsigned bits) {
    bench.write(kNode, object::kControlword, cia402::kWordEnableOperation | static_cast<int>(bits),
                2);
  }
  /// Bits 10, 12 and 13.
  unsigned homing() { return status() & 0x3400U; }
  std::int64_t position() { return bench.value(kNode, object::kActualPosition); }
};

constexpr unsigned kIdle = can::kTargetReached;
constexpr unsigned kDone = can::kTargetReached | can::kHomingAttained;
constexpr unsigned kFailed = can::kTargetReached | can::kHomingError;

TEST_F(HomingDrive, MakesThePresentPositionHome) {
  for (const int number : {35, 37}) {
    ASSERT_EQ(method(number), Abort::kNone);
    EXPECT_NE(homing(), kFailed);
    word(0);
    word(can::kBitStart);
    EXPECT_EQ(homing(), kDone) << number;
    EXPECT_EQ(position(), 0);
    bench.let_pass(50'000);
    EXPECT_EQ(bench.setpoint(0).goal_count, 8192) << "nothing moves";
  }
}

// CiA 402: zero position = home position + home offset.
TEST_F(HomingDrive, CountsFromHomeAndItsOffset) {
  method(37);
  bench.write(kNode, object::kHomeOffset, 100, 4);
  word(can::kBitStart);
  EXPECT_EQ(position(), -100);
  bench.write(kNode, object::kMode, cia402::kModeCyclicPosition, 1);
  bench.let_pass(5000);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8192) << "an earlier target had another zero";
  target(8);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8192 + 108);
}

TEST_F(HomingDrive, IsIdleUntilItIsStartedByAnEdge) {
  method(37);
  EXPECT_EQ(homing(), kIdle);
  bench.let_pass(5000);
  EXPECT_EQ(position(), 8192);
  word(can::kBitStart);
  EXPECT_EQ(homing(), kDone);
  measured().position_count = 8200;
  bench.plant.blocked[0] = true;
  word(can::kBitStart);
  EXPECT_EQ(position(), 8) << "the bit stayed: no second start";
}

TEST_F(HomingDrive, HaltHoldsItBack) {
  method(37);
  word(can::kBitStart | can::kBitHalt);
  EXPECT_EQ(homing(), kIdle);
  EXPECT_EQ(position(), 8192);
  word(can::kBitStart);
  EXPECT_EQ(homing(), kDone);
}

TEST_F(HomingDrive, RefusesMethodsThatNeedASwitch) {
  for (const int number : {1, 7, 17, 19, 33, 34, 36, 38, -1, -4}) {
    EXPECT_EQ(method(number), Abort::kValueRange) << number;
  }
  EXPECT_EQ(method(0), Abort::kNone);
}

TEST_F(HomingDrive, WithoutAMethodItFails) {
  word(can::kBitStart);
  EXPECT_EQ(homing(), kFailed);
  EXPECT_EQ(position(), 8192);
  EXPECT_EQ(bench.state(kNode), State::kOperationEnabled) << "no fault of the drive";
  method(37);
  word(0);
  word(can::kBitStart);
  EXPECT_EQ(homing(), kDone);
}

TEST_F(HomingDrive, KeepsItsSpeedsThoughItsMethodsMoveNothing) {
  EXPECT_EQ(bench.write(kNode, profile_at::kSwitchSpeed, 300, 4), Abort::kNone);
  EXPECT_EQ(bench.write(kNode, profile_at::kZeroSpeed, 30, 4), Abort::kNone);
  EXPECT_EQ(bench.write(kNode, profile_at::kHomingAcceleration, 3000, 4), Abort::kNone);
  EXPECT_EQ(bench.value(kNode, profile_at::kSwitchSpeed), 300);
  EXPECT_EQ(bench.value(kNode, {0x6099, 0}), 2);
  EXPECT_EQ(bench.write(kNode, {0x6099, 3}, 1, 4), Abort::kNoSubindex);
}

TEST_F(HomingDrive, HomeIsStoredWithTheOtherSettings) {
  constexpr std::int64_t kSave = 0x65766173;
  method(37);
  bench.write(kNode, profile_at::kVelocity, 777, 4);
  word(can::kBitStart);
  bench.nmt(canopen::NmtCommand::kResetNode, kNode);
  EXPECT_EQ(position(), 8192) << "it was not stored";
  bench.enable(kNode);
  bench.write(kNode, object::kMode, can::kModeHoming, 1);
  method(37);
  bench.write(kNode, profile_at::kVelocity, 777, 4);
  word(can::kBitStart);
  EXPECT_EQ(bench.write(kNode, {0x1010, 1}, kSave, 4), Abort::kNone);
  bench.nmt(canopen::NmtCommand::kResetNode, kNode);
  EXPECT_EQ(position(), 0);
  EXPECT_EQ(bench.value(kNode, profile_at::kHomingMethod), 37);
  EXPECT_EQ(bench.value(kNode, profile_at::kVelocity), 777);
  EXPECT_EQ(bench.value(kNode, object::kModeDisplay), can::kModeHoming);
}

}  // namespace
}  // namespace verp
