#include <gtest/gtest.h>

#include "host/twin/can/device_node.hpp"
#include "tests/host/can/virtual_drive.hpp"

namespace verp {
namespace {

using canopen::Abort;
using canopen::cia402::State;
using test::CanBench;
using test::kNode;
using test::VirtualDrive;
namespace cia402 = canopen::cia402;
namespace plan = canopen::plan;
namespace object = canopen::cia402::object;

TEST_F(VirtualDrive, IsACia402ServoDriveWithItsProductCode) {
  EXPECT_EQ(bench.value(kNode, plan::kDeviceType), 0x00020192);
  EXPECT_EQ(bench.value(kNode, plan::kProductCode), 402);
}

TEST_F(VirtualDrive, HoldsWhereItIsUntilItsFirstTarget) {
  measured().position_count = 8300;
  bench.enable(kNode);
  EXPECT_EQ(bench.state(kNode), State::kOperationEnabled);
  EXPECT_TRUE(bench.setpoint(0).torque_on);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8300);
  target(8400);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8400);
}

TEST_F(VirtualDrive, FollowsATargetThatWasThereBeforeTorque) {
  target(8250);
  bench.enable(kNode);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8250);
}

TEST_F(VirtualDrive, ForgetsItsTargetWithItsTorque) {
  bench.enable(kNode);
  target(8400);
  bench.let_pass(2000);
  bench.control(kNode, cia402::kWordDisableVoltage);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  measured().position_count = 7000;
  bench.enable(kNode);
  EXPECT_EQ(bench.setpoint(0).goal_count, 7000);
}

TEST_F(VirtualDrive, HasNoTorqueButInOperation) {
  bench.write(kNode, object::kMode, cia402::kModeCyclicPosition, 1);
  EXPECT_EQ(bench.state(kNode), State::kSwitchOnDisabled);
  bench.control(kNode, cia402::kWordShutdown);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  bench.control(kNode, cia402::kWordSwitchOn);
  EXPECT_EQ(bench.state(kNode), State::kSwitchedOn);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  bench.control(kNode, cia402::kWordEnableOperation);
  EXPECT_TRUE(bench.setpoint(0).torque_on);
}

TEST_F(VirtualDrive, WithoutModeEightFollowsNoTarget) {
  for (const std::uint16_t word :
       {cia402::kWordShutdown, cia402::kWordSwitchOn, cia402::kWordEnableOperation}) {
    bench.control(kNode, word);
  }
  target(9000);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8192);
  EXPECT_EQ(status() & cia402::kFollowsCommand, 0);
  EXPECT_EQ(bench.write(kNode, object::kMode, cia402::kModeCyclicPosition, 1), Abort::kNone);
  EXPECT_EQ(bench.value(kNode, object::kModeDisplay), cia402::kModeCyclicPosition);
  EXPECT_EQ(bench.setpoint(0).goal_count, 9000);
  EXPECT_NE(status() & cia402::kFollowsCommand, 0);
}

TEST_F(VirtualDrive, CutsTargetsAtItsLimitsAndSaysSo) {
  bench.write(kNode, object::kMinPosition, 8000, 4);
  bench.write(kNode, object::kMaxPosition, 8500, 4);
  bench.enable(kNode);
  for (const auto& [asked, given] : {std::pair{7000, 8000}, {9000, 8500}, {8100, 8100}}) {
    target(asked);
    EXPECT_EQ(bench.setpoint(0).goal_count, given);
    EXPECT_EQ((status() & cia402::kInternalLimit) != 0, asked != given);
  }
}

// CiA 402: zero position = home position + home offset.
TEST_F(VirtualDrive, CountsFromItsHomeOffset) {
  bench.write(kNode, object::kHomeOffset, 192, 4);
  EXPECT_EQ(bench.value(kNode, object::kActualPosition), 8000);
  bench.enable(kNode);
  target(8010);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8202);
}

TEST_F(VirtualDrive, JoinsTargetsOverTheInterpolationTime) {
  bench.write(kNode, object::kPeriodValue, 80, 1);
  bench.write(kNode, object::kPeriodExponent, -4, 1);
  bench.enable(kNode);
  EXPECT_EQ(bench.setpoint(0).profile_ms, 8u);
}

TEST_F(VirtualDrive, MaxTorqueLimitsTheDuty) {
  bench.write(kNode, object::kMaxTorque, 600, 2);
  EXPECT_EQ(bench.setpoint(0).pwm_limit, dxl::kFullPwm * 600 / 1000);
  bench.write(kNode, object::kMaxTorque, 1000, 2);
  EXPECT_EQ(bench.setpoint(0).pwm_limit, dxl::kFullPwm);
  bench.write(kNode, object::kMaxTorque, 3000, 2);
  EXPECT_EQ(bench.setpoint(0).pwm_limit, dxl::kFullPwm) << "there is no more than all";
}

TEST_F(VirtualDrive, HasTheGainsOfItsCommissioning) {
  EXPECT_EQ(bench.setpoint(0).p_gain, 590);
  EXPECT_EQ(bench.setpoint(0).d_gain, 80);
  EXPECT_EQ(bench.write(kNode, {0x2002, 1}, 700, 2), Abort::kNone);
  EXPECT_EQ(bench.setpoint(0).p_gain, 700);
  EXPECT_EQ(bench.write(kNode, {0x2002, 1}, 16384, 2), Abort::kValueTooHigh);
  EXPECT_EQ(bench.write(kNode, {0x2002, 4}, 1, 2), Abort::kNoSubindex);
}

TEST_F(VirtualDrive, AQuickStopEndsTorqueOrHoldsAsItsOptionSays) {
  for (const int option : {2, 6}) {
    bench.control(kNode, cia402::kWordDisableVoltage);
    bench.write(kNode, object::kQuickStopOption, option, 2);
    bench.enable(kNode);
    target(9000);
    bench.let_pass(2000);
    bench.plant.blocked[0] = true;
    measured() = {.position_count = 8600, .velocity_rad_s = 1};
    bench.write(kNode, object::kControlword, cia402::kWordQuickStop, 2);
    EXPECT_EQ(bench.state(kNode), State::kQuickStopActive) << "it still moves";
    EXPECT_EQ(bench.setpoint(0).goal_count, 8600);
    EXPECT_EQ(bench.setpoint(0).profile_ms, 0u);
    measured().velocity_rad_s = 0;
    bench.let_pass(3000);
    const bool holds = option == 6;
    EXPECT_EQ(bench.state(kNode), holds ? State::kQuickStopActive : State::kSwitchOnDisabled);
    EXPECT_EQ(bench.setpoint(0).torque_on, holds);
    bench.plant.blocked[0] = false;
  }
  bench.control(kNode, cia402::kWordEnableOperation);
  EXPECT_EQ(bench.state(kNode), State::kOperationEnabled) << "option 6 lets it go on";
}

// A CiA 402 master waits for it.
TEST_F(VirtualDrive, TellsItsStatuswordWheneverItBecomesOperational) {
  using canopen::NmtCommand;
  for (const NmtCommand first : {NmtCommand::kResetNode, NmtCommand::kResetCommunication,
                                 NmtCommand::kEnterPreOperational, NmtCommand::kStop}) {
    for (int times = 0; times < 2; ++times) {
      bench.nmt(first, kNode);
      bench.bus.send(canopen::nmt_frame(NmtCommand::kStart, kNode));
      std::vector<CanFrame> told;
      for (const CanFrame& frame : bench.listen(20'000)) {
        if (frame.id == canopen::tpdo_id(1, kNode)) told.push_back(frame);
      }
      ASSERT_EQ(told.size(), 1u) << static_cast<int>(first);
      EXPECT_EQ(told[0].size, 2);
      EXPECT_EQ(told[0].data[0] & 0x6F, 0x40) << "switch on disabled";
    }
  }
}

TEST_F(VirtualDrive, MeasuresSpeedAndTorque) {
  measured().velocity_rad_s = 2;
  measured().duty = -0.25;
  EXPECT_EQ(bench.value(kNode, object::kActualVelocity), 5215);  // 2 * 16384 / 2 pi
  EXPECT_EQ(bench.value(kNode, object::kActualTorque), -250);
}

TEST_F(VirtualDrive, GivesPositionAndTorqueTheirScale) {
  EXPECT_EQ(bench.value(kNode, {0x608F, 0}), 2);
  EXPECT_EQ(bench.value(kNode, {0x608F, 1}), 16384);
  EXPECT_EQ(bench.value(kNode, {0x608F, 2}), 1);
  EXPECT_EQ(bench.value(kNode, {0x6075, 0}), 0) << "this plant does not know it";
  bench.plant.rated = {.torque_n_m = 3.1, .current_a = 2.3};
  sim::Plant& plant = bench.plant;
  bench.bus.plug_in(std::make_unique<can::DriveNode>(can::drive_identity(402, 50), 50, plant, 0,
                                                     can::DriveSetup{.counts_per_rad = 1000}));
  bench.let_pass(2000);
  EXPECT_EQ(bench.value(50, {0x6075, 0}), 2300) << "mA";
  EXPECT_EQ(bench.value(50, {0x6076, 0}), 3100) << "mNm";
  measured().duty = 0.5;
  measured().current_a = -1.15;
  EXPECT_EQ(bench.value(50, object::kActualTorque), -500);
}

TEST_F(VirtualDrive, KeepsWhatIsStoredThroughResetsAndPowerUntilDefaultsAreRestored) {
  using canopen::NmtCommand;
  constexpr std::int64_t kSave = 0x65766173, kLoad = 0x64616F6C;  // "save", "load"
  const auto values = [this] {
    return std::vector<std::int64_t>{
        bench.value(kNode, object::kMaxTorque), bench.value(kNode, {0x2002, 1}),
        bench.value(kNode, {0x1800, 3}), bench.value(kNode, object::kProducerHeartbeat)};
  };
  const auto set = [this](int torque, int gain, int inhibit, int beat) {
    bench.write(kNode, object::kMaxTorque, torque, 2);
    bench.write(kNode, {0x2002, 1}, gain, 2);
    const std::int64_t cob_id = bench.value(kNode, {0x1800, 1});
    bench.write(kNode, {0x1800, 1}, cob_id | 0x80000000, 4);
    bench.write(kNode, {0x1800, 3}, inhibit, 2);
    bench.write(kNode, {0x1800, 1}, cob_id, 4);
    bench.write(kNode, object::kProducerHeartbeat, beat, 2);
  };
  const std::vector<std::int64_t> defaults = values(), stored = {500, 700, 30, 200};
  set(500, 700, 30, 200);
  ASSERT_EQ(values(), stored);
  EXPECT_EQ(bench.write(kNode, {0x1010, 1}, kLoad, 4), Abort::kCannotStore);
  bench.nmt(NmtCommand::kResetNode, kNode);
  EXPECT_EQ(values(), defaults) << "the wrong word stores nothing";
  set(500, 700, 30, 200);
  bench.enable(kNode);
  EXPECT_EQ(bench.write(kNode, {0x1010, 1}, kSave, 4), Abort::kNone);
  set(900, 100, 10, 0);
  bench.nmt(NmtCommand::kResetNode, kNode);
  EXPECT_EQ(values(), stored);
  EXPECT_EQ(bench.state(kNode), State::kSwitchOnDisabled) << "a command is no setting";
  bench.bus.set_powered(kNode, false);
  bench.bus.set_powered(kNode, true);
  bench.let_pass(2000);
  EXPECT_EQ(values(), stored);
  EXPECT_EQ(bench.write(kNode, {0x1011, 1}, kLoad, 4), Abort::kNone);
  EXPECT_EQ(values(), stored) << "until it is reset";
  bench.nmt(NmtCommand::kResetNode, kNode);
  EXPECT_EQ(values(), defaults);
}

TEST(VirtualDrives, TakeTheirOwnPartOfASharedFrame) {
  CanBench bench(3);
  for (int j = 0; j < 3; ++j) {
    const std::uint8_t node = bench.params.joint[j].servo_id;
    const auto mapping = plan::shared_mapping(plan::kGoals, bench.params, j);
    bench.write(node, {0x1400, 1}, 0x80000000, 4);
    bench.write(node, {0x1600, 0}, 0, 1);
    for (std::uint8_t i = 0; i < mapping.count; ++i) {
      const auto sub = static_cast<std::uint8_t>(i + 1);
      EXPECT_EQ(bench.write(node, {0x1600, sub}, mapping.entries[i].value(), 4), Abort::kNone);
    }
    bench.write(node, {0x1600, 0}, mapping.count, 1);
    const std::uint16_t id = plan::shared_id(plan::kGoals, bench.params, j / plan::kGoals.width);
    EXPECT_EQ(bench.write(node, {0x1400, 1}, id, 4), Abort::kNone);
  }
  bench.nmt(canopen::NmtCommand::kStart);
  for (std::uint8_t node = 1; node <= 3; ++node) bench.enable(node);
  CanFrame pair = canopen::classic_frame(canopen::rpdo_id(1, 1), 8);
  canopen::put_le(pair.data, 8001, 4);
  canopen::put_le(pair.data + 4, 8002, 4);
  CanFrame last = canopen::classic_frame(canopen::rpdo_id(1, 3), 4);
  canopen::put_le(last.data, 8003, 4);
  bench.bus.send(pair);
  bench.bus.send(last);
  bench.let_pass(1000);
  for (int j = 0; j < 3; ++j) EXPECT_EQ(bench.setpoint(j).goal_count, 8001 + j);
}

TEST(VirtualDrives, EachGroupAnswersItsOwnSync) {
  CanBench bench(7);
  const std::uint8_t groups = plan::sync_groups(bench.params);
  for (int j = 0; j < 7; ++j) {
    const std::uint8_t node = bench.params.joint[j].servo_id;
    bench.write(node, plan::kSyncOverflow, groups, 1);
    bench.write(node, {0x1801, 2}, groups, 1);
    EXPECT_EQ(bench.write(node, {0x1801, 6}, plan::group_of_joint(j), 1), Abort::kNone);
    EXPECT_EQ(bench.write(node, {0x1801, 1}, 0x280 + node, 4), Abort::kNone);
  }
  bench.nmt(canopen::NmtCommand::kStart);
  bench.let_pass(2000);
  for (int round = 0; round < 3; ++round) {
    for (std::uint8_t counter = 1; counter <= groups; ++counter) {
      bench.sync(counter);
      std::vector<std::uint32_t> drives;
      for (const CanFrame& frame : bench.listen(2000)) {
        if (frame.id > 0x280 && frame.id < 0x2E0) drives.push_back(frame.id - 0x280);
      }
      std::vector<std::uint32_t> expected;
      for (int j = 0; j < 7; ++j) {
        if (plan::group_of_joint(j) == counter) {
          expected.push_back(bench.params.joint[j].servo_id);
        }
      }
      EXPECT_EQ(drives, expected) << "SYNC " << int{counter};
    }
  }
}

}  // namespace
}  // namespace verp
