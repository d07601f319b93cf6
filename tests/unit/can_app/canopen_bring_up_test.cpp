#include "firmware/app/bring_up_report.hpp"

#include <gtest/gtest.h>

#include "tests/unit/can_app/can_loop.hpp"

namespace verp::app {
namespace {

using canopen::cia402::State;
using test::CanBench;
using test::kBenchJoints;
using Loop = test::CanLoop;

TEST(CanopenBringUp, LeavesEveryDriveSetUpAndWithoutTorque) {
  Loop& loop = test::new_can_loop();
  loop.up();
  for (int j = 0; j < kBenchJoints; ++j) {
    const test::DriveNode& drive = loop.bench.drives[j];
    const canopen::cia402::DriveObjects& objects = drive.application.objects;
    EXPECT_EQ(objects.mode, canopen::cia402::kModeCyclicPosition);
    EXPECT_EQ(
        canopen::cia402::interpolation_period_us(objects.period_value, objects.period_exponent),
        loop.bench.params.period_us);
    EXPECT_EQ(objects.min_position, j % 2 == 0 ? -901 : -1901);
    EXPECT_EQ(objects.max_position, j % 2 == 0 ? 2101 : 1101);
    EXPECT_EQ(objects.following_window, UINT32_MAX);
    EXPECT_EQ(objects.abort_connection, 3);
    EXPECT_EQ(objects.quick_stop_option, 6);
    EXPECT_TRUE(drive.state() == State::kSwitchOnDisabled);
    EXPECT_TRUE(drive.device.state() == canopen::NmtState::kOperational);
    EXPECT_EQ(drive.resets, 1);
  }
}

TEST(CanopenBringUp, AsksForThePeriodToTheNearestTenthOfAMillisecond) {
  Loop& loop = test::new_can_loop();
  loop.bench.params.period_us = 4'480;
  loop.up();
  const auto& objects = loop.bench.drives[0].application.objects;
  EXPECT_EQ(canopen::cia402::interpolation_period_us(objects.period_value, objects.period_exponent),
            4'500u);
}

TEST(CanopenBringUp, NamesASilentNodeAndLeavesNobodyStiff) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  ASSERT_TRUE(loop.all_in(State::kOperationEnabled));
  loop.bench.drives[4].off = true;
  CanopenServos again(loop.bench.params, loop.bench);
  const BringUpReport report = again.bring_up();
  EXPECT_TRUE(report.status == BringUpStatus::kSilent);
  EXPECT_EQ(report.device_id, 15);
  EXPECT_EQ(report.address, 0x1000);
  for (int j = 0; j < kBenchJoints; ++j) {
    const bool limp = loop.bench.drives[j].state() == State::kSwitchOnDisabled;
    EXPECT_TRUE(limp || j == 4) << j;
  }
}

// A reset would drop another controller's robot.
TEST(CanopenBringUp, SendsNothingWhileSomebodyElseCommandsNodes) {
  for (const std::uint32_t id : {0x000u, 0x080u, 0x77Fu, 0x1FFu, 0x20Bu, 0x60Bu}) {
    Loop& loop = test::new_can_loop();
    loop.bench.of_other = canopen::classic_frame(id, 2);
    loop.bench.others = 1;
    const BringUpReport report = loop.servos.bring_up();
    EXPECT_TRUE(report.status == BringUpStatus::kOccupied) << id;
    EXPECT_EQ(report.address, id);
    EXPECT_EQ(loop.bench.sent, 0u) << id;
    loop.up();
  }
}
TEST(CanopenBringUp, IsNotKeptFromItByWhatNodesAndDesksSay) {
  for (const std::uint32_t id : {0x08Bu, 0x18Bu, 0x58Bu, 0x67Fu, 0x70Bu, 0x7FFu}) {
    Loop& loop = test::new_can_loop();
    loop.bench.of_other = canopen::classic_frame(id, 2);
    loop.bench.others = 1;
    loop.up();
  }
}

// No earlier setting may stay, least of all a lower torque.
TEST(CanopenBringUp, ResetsOneAgainThatDidNotHearIt) {
  Loop& loop = test::new_can_loop();
  loop.bench.drives[2].missed_resets = 1;
  loop.up();
  EXPECT_EQ(loop.bench.drives[2].resets, 1);
  EXPECT_EQ(loop.bench.drives[1].resets, 1);
}
TEST(CanopenBringUp, NamesOneThatAnswersAndCannotBeReset) {
  Loop& loop = test::new_can_loop();
  loop.bench.drives[2].missed_resets = 1000;
  const BringUpReport report = loop.servos.bring_up();
  EXPECT_TRUE(report.status == BringUpStatus::kNotReset);
  EXPECT_EQ(report.device_id, 13);
}

TEST(CanopenBringUp, RefusesAnotherModelAndNamesBoth) {
  Loop& loop = test::new_can_loop();
  loop.bench.params.servo[0].model_number = 4321;
  const BringUpReport report = loop.servos.bring_up();
  EXPECT_TRUE(report.status == BringUpStatus::kWrongModel);
  EXPECT_EQ(report.device_id, 11);
  EXPECT_EQ(report.expected, 4321);
  EXPECT_EQ(report.found, test::DriveNode::kProduct);
}
TEST(CanopenBringUp, RefusesASensorInADrivesPlace) {
  Loop& loop = test::new_can_loop();
  loop.bench.params.joint[3].servo_id = test::kBenchImu;
  loop.bench.params.imu.device_id = 0;
  const BringUpReport report = loop.servos.bring_up();
  EXPECT_TRUE(report.status == BringUpStatus::kWrongModel);
  EXPECT_EQ(report.device_id, test::kBenchImu);
  EXPECT_EQ(report.address, 0x1000);
}
TEST(CanopenBringUp, RefusesIdsThatCanopenHasNotOrTwiceTheSame) {
  for (const std::uint8_t id : {std::uint8_t{200}, std::uint8_t{127}, std::uint8_t{12}}) {
    Loop& loop = test::new_can_loop();
    loop.bench.params.joint[0].servo_id = id;
    CanopenServos servos(loop.bench.params, loop.bench);
    EXPECT_TRUE(servos.bring_up().status == BringUpStatus::kRefused) << id;
    EXPECT_EQ(loop.bench.sent, 0u);
  }
}

TEST(CanopenBringUp, TakesADriveOutOfAFaultThatIsGoneButNotOutOfOneThatStays) {
  Loop& loop = test::new_can_loop();
  loop.up();
  loop.bench.drives[1].fail(canopen::ErrorCode::kOverTemperature, false);
  loop.up();
  EXPECT_TRUE(loop.bench.drives[1].state() == State::kSwitchOnDisabled);
  loop.bench.drives[1].stuck = true;
  const BringUpReport report = loop.servos.bring_up();
  EXPECT_TRUE(report.status == BringUpStatus::kHardwareError);
  EXPECT_EQ(report.device_id, 12);
  EXPECT_EQ(report.found, dxl::kOverheatingError);
}

TEST(CanopenBringUp, ReadsBackWhatADriveConfirmed) {
  Loop& loop = test::new_can_loop();
  loop.bench.drives[3].application.forgetful = true;
  const BringUpReport report = loop.servos.bring_up();
  EXPECT_TRUE(report.status == BringUpStatus::kNotVerified);
  EXPECT_EQ(report.device_id, 14);
  EXPECT_EQ(report.address, 0x6065);
}

}  // namespace
}  // namespace verp::app
