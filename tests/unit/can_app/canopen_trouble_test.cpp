#include <gtest/gtest.h>

#include "tests/unit/can_app/can_loop.hpp"

namespace verp::app {
namespace {

using canopen::cia402::State;
using test::kAll;
using test::kBenchJoints;
using Loop = test::CanLoop;

constexpr std::uint32_t kThird = 1u << 2;

// A leg that stiffens first throws the robot.
TEST(CanopenTrouble, DrivesWaitForEachOtherBeforeTheyGetTorqueButNotForEver) {
  Loop& loop = test::new_can_loop();
  loop.up();
  loop.bench.deaf_to = canopen::rpdo_id(2, 11);
  loop.outputs.torque_enable = kAll;
  loop.run(10);
  for (int j = 4; j < kBenchJoints; ++j) {
    EXPECT_TRUE(loop.bench.drives[j].state() == State::kSwitchedOn) << j;
  }
  loop.run(30);
  for (int j = 4; j < kBenchJoints; ++j) {
    EXPECT_TRUE(loop.bench.drives[j].state() == State::kOperationEnabled) << j;
  }
}

// The limit is lost with the power.
TEST(CanopenTrouble, ADriveThatWasSetUpAgainRisesNoStrongerThanAllowed) {
  Loop& loop = test::new_can_loop();
  loop.bench.params.rise_torque_percent = 40;
  loop.outputs.mode = static_cast<std::uint8_t>(safety::Mode::kRising);
  loop.enable();
  loop.outputs.torque_enable = 0;
  loop.run(5);
  loop.bench.drives[0].reboot();
  loop.run(60);
  EXPECT_EQ(loop.bench.drives[0].application.objects.max_torque, 1000);
  loop.outputs.torque_enable = kAll;
  for (int i = 0; i < 12; ++i) {
    loop.tick();
    const test::DriveApplication& drive = loop.bench.drives[0].application;
    EXPECT_FALSE(drive.drive.powered() && drive.objects.max_torque != 400) << i;
  }
  EXPECT_TRUE(loop.all_in(State::kOperationEnabled));
}

// Another master changed its mode of operation.
TEST(CanopenTrouble, ADriveThatDoesNotFollowItsTargetDoesNotCount) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  test::DriveApplication& drive = loop.bench.drives[2].application;
  drive.objects.mode = 1;
  drive.refresh();
  loop.run(5);
  EXPECT_EQ(loop.inputs.fresh, kAll & ~kThird);
  EXPECT_TRUE(drive.drive.powered()) << "what may hold a leg is not told to let go";
  loop.outputs.torque_enable = 0;
  loop.run(60);
  EXPECT_EQ(drive.objects.mode, canopen::cia402::kModeCyclicPosition) << "set up again";
  loop.enable();
  loop.run(5);
  EXPECT_EQ(loop.inputs.fresh, kAll);
}

TEST(CanopenTrouble, ADriveThatRebootsWhileItIsSetUpIsSetUpFromTheBeginning) {
  Loop& loop = test::new_can_loop();
  loop.up();
  loop.run(3);
  loop.bench.drives[2].reboot();
  loop.run(6);
  EXPECT_EQ(loop.bench.drives[2].application.objects.mode, canopen::cia402::kModeCyclicPosition)
      << "on the way";
  EXPECT_EQ(loop.inputs.fresh, kAll & ~kThird);
  loop.bench.drives[2].reboot();
  loop.run(60);
  EXPECT_EQ(loop.inputs.fresh, kAll);
  EXPECT_EQ(loop.bench.drives[2].application.objects.mode, canopen::cia402::kModeCyclicPosition);
}

std::uint16_t status_of(State state) {
  return canopen::cia402::state_bits(state) | canopen::cia402::kFollowsCommand;
}
TEST(DoubtedDrives, OneThatRebootedCountsOnlyWhenItIsSetUpOrStillHolds) {
  DoubtedDrives doubts{Params{}};
  doubts.rebooted(2);
  EXPECT_EQ(doubts.all(), kThird);
  EXPECT_FALSE(doubts.counts(2, status_of(State::kSwitchOnDisabled), false))
      << "what it answers with?";
  EXPECT_FALSE(doubts.counts(2, status_of(State::kSwitchOnDisabled), true));
  EXPECT_EQ(doubts.limp(), kThird);
  doubts.renewed(2);
  EXPECT_TRUE(doubts.counts(2, status_of(State::kSwitchOnDisabled), false));
  doubts.rebooted(2);
  EXPECT_TRUE(doubts.counts(2, status_of(State::kOperationEnabled), true))
      << "then it was no reboot";
  EXPECT_EQ(doubts.all(), 0u);
}

// A timeout must not look like an overrun.
TEST(CanopenTrouble, TheTimeOfATickIsThatOfItsBeginning) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.bench.drives[6].off = true;
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t before_us = loop.servos.now_us();
    loop.tick();
    EXPECT_NEAR(static_cast<double>(loop.servos.now_us() - before_us), 10'000.0, 300.0) << i;
  }
}

// The node received one SYNC twice.
TEST(CanopenTrouble, AnAnswerLaterInTheTickThanPlannedCountsAtOnce) {
  AnswerWatch watch;
  watch.plan(2, 1);
  for (int tick = 0; tick < 10; ++tick) {
    watch.begin();
    EXPECT_TRUE(watch.take(2, 3) == Answer::kFresh) << tick;
  }
  watch.begin();
  EXPECT_TRUE(watch.take(2, 1) == Answer::kOld) << "early: it may be late from the tick before";
}

TEST(CanopenTrouble, ASilentDriveIsMissedAloneAndSoonNotWaitedFor) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.bench.drives[2].off = true;
  for (int i = 0; i < 30; ++i) {
    loop.tick();
    EXPECT_EQ(loop.inputs.fresh, kAll & ~kThird);
    EXPECT_TRUE((loop.inputs.flags & kImuFresh) != 0);
  }
  EXPECT_GT(loop.servos.counters().timeouts, 5u);
  EXPECT_LT(loop.servos.counters().timeouts, 15u) << "six in the first 60 ms, then every 8th tick";
}

TEST(CanopenTrouble, ADriveThatKeptItsTorqueCountsAgain) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.bench.lost = canopen::tpdo_id(1, 13);
  loop.run(20);
  EXPECT_EQ(loop.inputs.fresh, kAll & ~kThird);
  EXPECT_TRUE(loop.bench.drives[2].state() == State::kOperationEnabled)
      << "what may hold a leg is not told to let go";
  loop.bench.lost = 0;
  loop.run(10);
  EXPECT_EQ(loop.inputs.fresh, kAll);
  EXPECT_EQ(loop.bench.drives[2].resets, 1);
}

TEST(CanopenTrouble, ADriveThatRebootsGetsNoTorqueBeforeTheRobotWasLetGo) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.bench.drives[2].reboot();
  for (int i = 0; i < 100; ++i) {
    loop.tick();
    EXPECT_EQ(loop.inputs.fresh & kThird, 0u) << i;
    EXPECT_FALSE(loop.bench.drives[2].application.drive.powered());
    EXPECT_TRUE(loop.bench.drives[3].state() == State::kOperationEnabled);
  }
  loop.outputs.torque_enable = 0;
  loop.run(100);
  EXPECT_EQ(loop.inputs.fresh, kAll);
  EXPECT_EQ(loop.bench.drives[2].application.objects.mode, canopen::cia402::kModeCyclicPosition);
  EXPECT_EQ(loop.bench.drives[2].application.objects.abort_connection, 3);
  loop.outputs.torque_enable = kAll;
  loop.run(12);
  EXPECT_TRUE(loop.all_in(State::kOperationEnabled));
}

TEST(CanopenTrouble, AProgramThatBootsWithADrivesNodeIdStopsNoDrive) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  for (int tick = 0; tick < 60; ++tick) {
    if (tick % 7 == 0) {
      loop.bench.of_other = canopen::classic_frame(canopen::heartbeat_id(13), 1);
      loop.bench.others = 1 + tick % 2;
    }
    loop.tick();
    ASSERT_EQ(loop.inputs.fresh, kAll) << tick;
    ASSERT_TRUE(loop.all_in(State::kOperationEnabled)) << tick;
  }
  EXPECT_EQ(loop.bench.others, 0);
}

// 50 objects take longer than a tick.
TEST(CanopenTrouble, SettingUpAgainNeverHoldsATick) {
  Loop& loop = test::new_can_loop();
  loop.up();
  loop.run(3);
  loop.bench.drives[2].reboot();
  loop.bench.drives[5].reboot();
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t before_us = loop.servos.now_us();
    loop.tick();
    EXPECT_NEAR(static_cast<double>(loop.servos.now_us() - before_us), 10'000.0, 4'000.0)
        << "or it would count as an overrun, tick " << i;
  }
  loop.run(50);
  EXPECT_EQ(loop.inputs.fresh, kAll);
}

TEST(CanopenTrouble, ASensorThatRebootsIsSetUpAgainWhileTheRobotStands) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.bench.imu.reboot();
  loop.tick();
  EXPECT_EQ(loop.inputs.flags & kImuFresh, 0);
  int ticks = 1;
  while ((loop.inputs.flags & kImuFresh) == 0 && ticks < 100) {
    loop.tick();
    ++ticks;
  }
  EXPECT_LT(ticks, 50) << "before the core would let the robot down";
  EXPECT_TRUE(loop.all_in(State::kOperationEnabled));
}

// No node acknowledges a start command.
TEST(CanopenTrouble, ANodeThatIsNotOperationalIsStartedAgain) {
  Loop& loop = test::new_can_loop();
  loop.up();
  loop.bench.drives[6].device.receive(
      canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, 17), 0);
  loop.bench.right.device.receive(
      canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, 102), 0);
  loop.run(200);
  EXPECT_EQ(loop.inputs.fresh, kAll);
  EXPECT_TRUE((loop.inputs.flags & kFeetFresh) != 0);
}

TEST(CanopenTrouble, AFaultTakesADriveOutUntilTheRobotWasLetGo) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.run(20);
  loop.bench.drives[2].application.telemetry =
      canopen::plan::Telemetry{120, 40, dxl::kOverloadError}.value();
  loop.bench.drives[2].fail(canopen::ErrorCode::kOverCurrent, false);
  int told = 0;
  for (int i = 0; i < 3; ++i) {
    loop.tick();
    if (loop.inputs.slow_joint == 2 && loop.inputs.slow_error == dxl::kOverloadError) ++told;
  }
  EXPECT_EQ(loop.inputs.fresh, kAll & ~kThird);
  EXPECT_GE(told, 1) << "its emergency brought its turn forward";
  EXPECT_EQ(loop.servos.counters().errors, 1u);
  loop.run(100);
  EXPECT_TRUE(loop.bench.drives[2].state() == State::kFault) << "no reset while others stand";
  loop.outputs.torque_enable = 0;
  loop.run(100);
  EXPECT_EQ(loop.inputs.fresh, kAll);
  EXPECT_TRUE(loop.bench.drives[2].state() == State::kSwitchOnDisabled);
}

// CiA 301: it answers another SYNC from then on.
TEST(CanopenTrouble, ADriveThatMissedASyncIsFoundWhereItAnswersNow) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  const std::uint32_t before = loop.servos.counters().timeouts;
  CanFrame extra = canopen::classic_frame(canopen::kSyncId, 1);
  extra.data[0] = 9;
  loop.bench.drives[2].device.receive(extra, 0);
  loop.bench.drives[6].device.receive(extra, 0);
  CanFrame frame;
  while (loop.bench.drives[2].device.next(frame, 0) || loop.bench.drives[6].device.next(frame, 0)) {
  }
  loop.run(10);
  const std::uint32_t after = loop.servos.counters().timeouts;
  EXPECT_LT(after - before, 10u);
  for (int i = 0; i < 20; ++i) {
    loop.tick();
    EXPECT_EQ(loop.inputs.fresh, kAll);
  }
  EXPECT_EQ(loop.servos.counters().timeouts, after) << "it is waited for where it answers";
}

TEST(CanopenTrouble, WithoutABusTicksGoOnAndAllIsBackAfterwards) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.bench.down = true;
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t before_us = loop.bench.now_us();
    loop.tick();
    EXPECT_EQ(loop.inputs.fresh, 0u);
    EXPECT_EQ(loop.inputs.flags & (kImuFresh | kFeetFresh), 0);
    EXPECT_LT(loop.bench.now_us() - before_us, 10'000u);
  }
  EXPECT_GT(loop.servos.counters().refused, 20u);
  loop.bench.down = false;
  loop.run(20);
  EXPECT_EQ(loop.inputs.fresh, kAll);
  EXPECT_TRUE(loop.all_in(State::kOperationEnabled)) << "they kept their torque";
}

TEST(CanopenTrouble, FramesOfStrangersAreCountedAndChangeNothing) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.bench.babble = true;
  for (int i = 0; i < 20; ++i) {
    loop.tick();
    EXPECT_EQ(loop.inputs.fresh, kAll);
    for (int j = 0; j < kBenchJoints; ++j) EXPECT_EQ(loop.inputs.position_count[j], 200 + j);
  }
  EXPECT_GE(loop.servos.counters().strays, 20u);
}

}  // namespace
}  // namespace verp::app
