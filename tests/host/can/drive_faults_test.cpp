#include <gtest/gtest.h>

#include "host/twin/can/device_node.hpp"
#include "tests/host/can/virtual_drive.hpp"

namespace verp {
namespace {

using canopen::Abort;
using canopen::cia402::State;
using test::kNode;
using test::VirtualDrive;
namespace cia402 = canopen::cia402;
namespace plan = canopen::plan;
namespace object = canopen::cia402::object;

// As Bus Watchdog on serial servos.
TEST_F(VirtualDrive, HoldsByItselfWhenItsMasterIsSilent) {
  bench.enable(kNode);
  target(9000);
  watch_master(3, plan::kQuickStopAndHold, 20);
  EXPECT_EQ(bench.state(kNode), State::kOperationEnabled);
  bench.plant.blocked[0] = true;
  measured().position_count = 8700;
  bench.let_pass(110'000);
  EXPECT_EQ(bench.state(kNode), State::kQuickStopActive);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8700);
  EXPECT_TRUE(bench.setpoint(0).torque_on);
  target(9100);
  EXPECT_EQ(bench.setpoint(0).goal_count, 8700) << "deaf to targets until it is enabled again";
  bench.control(kNode, cia402::kWordEnableOperation);
  EXPECT_EQ(bench.setpoint(0).goal_count, 9100);
}

TEST_F(VirtualDrive, ASilentMasterIsAFaultIfTheOptionSaysSo) {
  bench.enable(kNode);
  watch_master(1, 2, 3);
  std::vector<canopen::Emergency> told = emergencies(110'000);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, 0x8130);
  EXPECT_EQ(bench.state(kNode), State::kFault);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  EXPECT_EQ(bench.value(kNode, object::kErrorCode), 0x8130 - 0x10000) << "an i16 to this bench";
  bench.control(kNode, cia402::kWordFaultReset);
  EXPECT_EQ(bench.state(kNode), State::kSwitchOnDisabled);
}

TEST_F(VirtualDrive, FallsBackToPreOperationalWithoutItsMasterAsItsErrorBehaviourSays) {
  const std::pair<int, std::uint8_t> rows[] = {{0, 0x7F}, {1, 0x05}, {2, 0x04}};
  for (const auto& [behaviour, state] : rows) {
    bench.nmt(canopen::NmtCommand::kResetNode, kNode);
    EXPECT_EQ(bench.write(kNode, {0x1029, 1}, behaviour, 1), Abort::kNone);
    bench.write(kNode, object::kProducerHeartbeat, 10, 2);
    bench.nmt(canopen::NmtCommand::kStart, kNode);
    watch_master(1, 2, 3);
    bench.let_pass(110'000);
    std::uint8_t told = 0;
    for (const CanFrame& frame : bench.listen(20'000)) {
      if (frame.id == canopen::heartbeat_id(kNode)) told = frame.data[0];
    }
    EXPECT_EQ(told, state) << behaviour;
  }
  bench.nmt(canopen::NmtCommand::kResetNode, kNode);
  EXPECT_EQ(bench.value(kNode, {0x1029, 1}), 0) << "CiA 301: pre-operational";
  EXPECT_EQ(bench.write(kNode, {0x1029, 1}, 3, 1), Abort::kValueRange);
}

TEST_F(VirtualDrive, ItsErrorCodeAgreesWithItsErrorRegister) {
  const auto expect = [this](int error_register, int code) {
    EXPECT_EQ(bench.value(kNode, object::kErrorRegister), error_register);
    EXPECT_EQ(bench.value(kNode, object::kErrorCode) & 0xFFFF, code);
  };
  bench.enable(kNode);
  watch_master(1, 2, 3);
  bench.let_pass(110'000);
  expect(0x11, 0x8130);
  watch_master(1, 2, 1);
  expect(0x11, 0x8130);
  bench.nmt(canopen::NmtCommand::kResetCommunication, kNode);
  EXPECT_EQ(bench.state(kNode), State::kFault);
  expect(0x11, 0x8130);
  bench.control(kNode, cia402::kWordFaultReset);
  expect(0, 0);
  measured().voltage_v = 9;
  bench.let_pass(2000);
  expect(0x05, 0x3220);
}

TEST_F(VirtualDrive, AMasterThatIsSilentBeforeThereIsTorqueIsToldAndIsNoFault) {
  watch_master(1, 2, 3);
  const std::vector<canopen::Emergency> told = emergencies(110'000);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, 0x8130);
  EXPECT_EQ(bench.state(kNode), State::kSwitchOnDisabled);
  EXPECT_EQ(bench.value(kNode, object::kErrorCode) & 0xFFFF, 0x8130);
  watch_master(1, 2, 1);
  EXPECT_EQ(bench.value(kNode, object::kErrorCode), 0);
}

TEST_F(VirtualDrive, ItsCounterGoesOnAtTheOtherEndOf32Bits) {
  measured().position_count = 10;
  bench.write(kNode, object::kHomeOffset, -0x7FFFFFFF, 4);
  bench.let_pass(2000);
  EXPECT_EQ(bench.value(kNode, object::kActualPosition), -0x7FFFFFFF - 1 + 9);
}

TEST_F(VirtualDrive, OverheatingIsAFaultUntilItIsCool) {
  bench.enable(kNode);
  measured().temperature_c = 81;
  const std::vector<canopen::Emergency> told = emergencies(10'000);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, 0x4310);
  EXPECT_EQ(bench.state(kNode), State::kFault);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  bench.control(kNode, cia402::kWordFaultReset);
  EXPECT_EQ(bench.state(kNode), State::kFault);
  measured().temperature_c = 60;
  bench.let_pass(2000);
  const auto before =
      plan::Telemetry::from(static_cast<std::uint32_t>(bench.value(kNode, plan::kTelemetry)));
  EXPECT_EQ(before, (plan::Telemetry{120, 60, dxl::kOverheatingError}));
  bench.control(kNode, 0);
  bench.control(kNode, cia402::kWordFaultReset);
  EXPECT_EQ(bench.state(kNode), State::kSwitchOnDisabled);
  EXPECT_EQ(bench.value(kNode, object::kErrorCode), 0);
}

// 18 V is low for 24 V, high for 12 V.
TEST_F(VirtualDrive, WhatSupplyIsLowOrHighIsThatOfItsMotor) {
  bench.plant.rated.nominal_v = 24;
  bench.bus.plug_in(std::make_unique<can::DriveNode>(can::drive_identity(402, 50), 50, bench.plant,
                                                     0, can::DriveSetup{.counts_per_rad = 1000}));
  const auto code_at = [this](double volts) {
    measured().voltage_v = volts;
    bench.let_pass(2000);
    return bench.value(50, object::kErrorCode) & 0xFFFF;
  };
  EXPECT_EQ(code_at(24), 0);
  EXPECT_EQ(code_at(18), 0x3220);
  code_at(24);
  EXPECT_EQ(code_at(33), 0x3210);
}

TEST_F(VirtualDrive, ALowSupplyIsToldAndKeepsTorque) {
  bench.enable(kNode);
  measured().voltage_v = 9.2;
  const std::vector<canopen::Emergency> told = emergencies(10'000);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, 0x3220);
  EXPECT_NE(status() & cia402::kWarning, 0);
  EXPECT_TRUE(bench.setpoint(0).torque_on);
  const auto telemetry =
      plan::Telemetry::from(static_cast<std::uint32_t>(bench.value(kNode, plan::kTelemetry)));
  EXPECT_EQ(telemetry.voltage_tenth_v, 92);
  EXPECT_EQ(telemetry.errors, dxl::kInputVoltageError);
  EXPECT_EQ(bench.value(kNode, object::kDcLinkVoltage), 9200);
}

TEST_F(VirtualDrive, AFollowingErrorIsAFaultIfItIsWatched) {
  bench.plant.blocked[0] = true;
  bench.enable(kNode);
  target(9000);
  EXPECT_TRUE(emergencies(60'000).empty()) << "not watched by default";
  bench.write(kNode, object::kFollowingTime, 20, 2);
  bench.write(kNode, object::kFollowingWindow, 100, 4);
  EXPECT_TRUE(emergencies(15'000).empty());
  const std::vector<canopen::Emergency> told = emergencies(10'000);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, 0x8611);
  EXPECT_EQ(bench.state(kNode), State::kFault);
  EXPECT_NE(status() & cia402::kFollowingError, 0);
  bench.control(kNode, cia402::kWordFaultReset);
  EXPECT_EQ(bench.state(kNode), State::kSwitchOnDisabled);
  EXPECT_EQ(status() & cia402::kFollowingError, 0);
}

TEST_F(VirtualDrive, NmtResetTakesTorqueAndSettings) {
  bench.enable(kNode);
  bench.write(kNode, object::kMaxTorque, 500, 2);
  bench.nmt(canopen::NmtCommand::kResetNode, kNode);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  EXPECT_EQ(bench.value(kNode, object::kMaxTorque), 1000);
}

TEST_F(VirtualDrive, AStoppedNodeDoesAsWithoutItsMaster) {
  bench.write(kNode, object::kAbortConnection, 2, 2);
  bench.enable(kNode);
  bench.nmt(canopen::NmtCommand::kStop, kNode);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
}

TEST_F(VirtualDrive, AStopIsAFaultWithTorqueOnlyAndIsToldWhenItMaySpeakAgain) {
  using canopen::NmtCommand;
  bench.nmt(NmtCommand::kStop, kNode);
  bench.nmt(NmtCommand::kStart, kNode);
  EXPECT_EQ(bench.state(kNode), State::kSwitchOnDisabled);
  bench.enable(kNode);
  bench.nmt(NmtCommand::kStop, kNode);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  bench.bus.send(canopen::nmt_frame(NmtCommand::kEnterPreOperational, kNode));
  const std::vector<canopen::Emergency> told = emergencies(5000);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, 0x8100);
  EXPECT_EQ(told[0].error_register, 0x11);
  EXPECT_EQ(bench.state(kNode), State::kFault);
  EXPECT_EQ(bench.value(kNode, object::kErrorCode) & 0xFFFF, 0x8100);
}

}  // namespace
}  // namespace verp
