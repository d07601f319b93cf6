#include "hal/fake/scripted_imu.hpp"
#include "tests/host/bus/app_fixture.hpp"

namespace verp::test {
namespace {

using AppInTrouble = AppLoop;

// After a reset in mid-walk, one servo is gone.
TEST_F(AppInTrouble, ABringUpThatFailsLeavesNobodyStiff) {
  ready();
  wanted.torque_enable = all();
  ticks(3);
  for (int j = 0; j < kJoints; ++j) ASSERT_TRUE(plant.setpoint(j).torque_on) << j;
  bus.set_connected(params.joint[0].servo_id, false);
  EXPECT_EQ(app.bring_up().status, app::BringUpStatus::kSilent);
  for (int j = 1; j < kJoints; ++j) EXPECT_FALSE(plant.setpoint(j).torque_on) << j;
}

TEST_F(AppInTrouble, BringUpNamesASilentDevice) {
  bus.set_connected(7, false);
  const app::BringUpReport report = app.bring_up();
  EXPECT_EQ(report.status, app::BringUpStatus::kSilent);
  EXPECT_EQ(report.device_id, 7);
}

TEST_F(AppInTrouble, BringUpNamesAWrongModel) {
  Params other = params;
  other.servo[0].model_number = dxl::kModelMx28;
  app::App<Tap, Script, Memory> stranger{other, tap, script, memory};
  const app::BringUpReport report = stranger.bring_up();
  EXPECT_EQ(report.status, app::BringUpStatus::kWrongModel);
  EXPECT_EQ(report.device_id, 1);
  EXPECT_EQ(report.expected, dxl::kModelMx28);
  EXPECT_EQ(report.found, dxl::kModelXm430W210);
}

TEST_F(AppInTrouble, BringUpSurvivesALostFrame) {
  tap.lose_sends = 1;
  ready();
}

TEST_F(AppInTrouble, ALostTorqueFrameIsMadeGood) {
  ready();
  ticks(5);
  wanted.torque_enable = all();
  ticks(5);
  wanted.torque_enable = 0;
  tap.lose_sends = 3;  // both reads, and torque off
  ticks(1);
  EXPECT_TRUE(plant.setpoint(0).torque_on);
  ticks(2);
  for (int j = 0; j < kJoints; ++j) EXPECT_FALSE(plant.setpoint(j).torque_on);
}

TEST_F(AppInTrouble, ASilentServoGoesStaleAloneAndCostsNoTick) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  bus.set_connected(6, false);
  ticks(3);
  EXPECT_EQ(app.inputs().fresh, without(5));
  EXPECT_EQ(app.inputs().position_count[5], 1005) << "keeps the last value";
  const std::uint32_t tick = app.inputs().tick;
  ticks(50);
  EXPECT_EQ(app.inputs().fresh, without(5));
  EXPECT_EQ(app.inputs().tick, tick + 50);
  EXPECT_EQ(app.inputs().flags & kOverrun, 0);
  bus.set_connected(6, true);
  ticks(2);
  EXPECT_EQ(app.inputs().fresh, all());
}

TEST_F(AppInTrouble, ASilentImuIsReportedStale) {
  ready();
  bus.set_connected(test::kImuId, false);
  ticks(3);
  EXPECT_EQ(app.inputs().flags & kImuFresh, 0);
  EXPECT_NE(app.inputs().flags & kFeetFresh, 0);
  EXPECT_EQ(app.inputs().fresh, all());
}

TEST_F(AppInTrouble, ADeadBusNeverHangsTheLoop) {
  ready();
  for (int id = 0; id < 253; ++id) bus.set_connected(static_cast<std::uint8_t>(id), false);
  ticks(100);
  EXPECT_EQ(app.inputs().fresh, 0u);
  EXPECT_EQ(app.inputs().flags & (kImuFresh | kFeetFresh | kSlowFresh), 0);
  EXPECT_EQ(app.inputs().tick, 99u);
  EXPECT_EQ(app.counters().timeouts, 200u);
}

TEST_F(AppInTrouble, AnAlertIsLookedUp) {
  ready();
  plant.measured[3].temperature_c = 90;
  for (int i = 0; i < kJoints; ++i) {
    ticks(1);
    EXPECT_EQ(app.inputs().slow_error, app.inputs().slow_joint == 3 ? dxl::kOverheatingError : 0);
    EXPECT_NE(app.inputs().flags & kSlowFresh, 0);
  }
}

TEST_F(AppInTrouble, BringUpNamesAServoWithAHardwareError) {
  ready();
  plant.measured[3].temperature_c = 90;
  ticks(kJoints + 1);
  plant.measured[3].temperature_c = 40;
  const app::BringUpReport report = app.bring_up();
  EXPECT_EQ(report.status, app::BringUpStatus::kHardwareError);
  EXPECT_EQ(report.device_id, params.joint[3].servo_id);
  EXPECT_EQ(report.found, dxl::kOverheatingError);
}

TEST_F(AppInTrouble, AMissedPeriodIsSkippedAndReported) {
  ready();
  ticks(3);
  std::uint8_t byte = 0;
  bus.poll(&byte, 1, 2 * params.period_us);  // another device holds the bus
  ticks(1);
  EXPECT_EQ(app.inputs().tick, 5u) << "ticks 3 and 4 had no time";
  EXPECT_EQ(bus.tick(), 5u);
  EXPECT_NE(app.inputs().flags & kOverrun, 0);
  ticks(1);
  EXPECT_EQ(app.inputs().flags & kOverrun, 0);
}

TEST_F(AppInTrouble, AClocksTicksAreTakenAsTheyAre) {
  ready();
  ticks(1);
  app.tick({.periods = 1, .overran = false});
  EXPECT_EQ(app.inputs().tick, 1u);
  EXPECT_EQ(app.inputs().flags & kOverrun, 0);
  app.tick({.periods = 1, .overran = true});
  EXPECT_EQ(app.inputs().tick, 2u);
  EXPECT_NE(app.inputs().flags & kOverrun, 0);
  app.tick({.periods = 40, .overran = true});
  EXPECT_EQ(app.inputs().tick, 42u);
  EXPECT_NE(app.inputs().flags & kOverrun, 0);
  app.tick({.periods = 1, .overran = false});
  EXPECT_EQ(app.inputs().tick, 43u);
  EXPECT_EQ(app.inputs().flags & kOverrun, 0);
}

TEST_F(AppInTrouble, AnImuOnTheBoardIsReadIfTheBusHasNone) {
  hal::ScriptedImu chip;
  app::App<Tap, Script, Memory, hal::ScriptedImu> on_bus{params, tap, script, memory, &chip};
  ASSERT_TRUE(chip.measure({{7, 8, 9}, {10, 11, 12}, 1}));
  on_bus.tick();
  EXPECT_EQ(on_bus.inputs().gyro_count[0], 1) << "the device on the bus has this";
  Params own = params;
  own.imu.device_id = 0;
  app::App<Tap, Script, Memory, hal::ScriptedImu> on_board{own, tap, script, memory, &chip};
  on_board.tick();
  EXPECT_NE(on_board.inputs().flags & kImuFresh, 0);
  EXPECT_EQ(on_board.inputs().gyro_count[0], 7);
  EXPECT_EQ(on_board.inputs().accel_count[2], 12);
  on_board.tick();
  EXPECT_EQ(on_board.inputs().flags & kImuFresh, 0) << "no sample is taken twice";
  app::App<Tap, Script, Memory> without{own, tap, script, memory};
  without.tick();
  EXPECT_EQ(without.inputs().flags & kImuFresh, 0);
}

TEST_F(AppInTrouble, TheChipOrTheBusSteersAsChosenBeforeTorqueComesOn) {
  ready();
  hal::ScriptedImu chip;
  app::App<Tap, Script, Memory, hal::ScriptedImu> both{params, tap, script, memory, &chip};
  std::uint64_t time_us = 0;
  const auto gyro_x = [&] {
    EXPECT_TRUE(chip.measure({{7, 8, 9}, {10, 11, 12}, ++time_us}));
    both.tick();
    EXPECT_NE(both.inputs().flags & kImuFresh, 0);
    return both.inputs().gyro_count[0];
  };
  EXPECT_EQ(gyro_x(), 1) << "the device on the bus has this";
  both.use_chip(true);
  EXPECT_EQ(gyro_x(), 7);
  both.tick();
  EXPECT_EQ(both.inputs().flags & kImuFresh, 0) << "the device on the bus does not stand in";
  both.use_chip(false);
  EXPECT_EQ(gyro_x(), 1);
  both.use_chip(true);
  wanted.torque_enable = all();
  EXPECT_EQ(gyro_x(), 7);
  both.use_chip(false);
  EXPECT_EQ(gyro_x(), 7);
  wanted.torque_enable = 0;
  gyro_x();
  both.use_chip(false);
  EXPECT_EQ(gyro_x(), 1);
}

TEST_F(AppInTrouble, NoiseMakesValuesStaleButNeverWrong) {
  ready();
  for (int j = 0; j < kJoints; ++j) {
    plant.measured[static_cast<std::size_t>(j)].position_count = 2000 - 100 * j;
  }
  tap.faults_per_mille = 5;
  constexpr int kTicks = 2000;
  int fresh = 0;
  for (int i = 0; i < kTicks; ++i) {
    ticks(1);
    for (int j = 0; j < kJoints; ++j) {
      if ((app.inputs().fresh >> j & 1) == 0) continue;
      ++fresh;
      ASSERT_EQ(app.inputs().position_count[j], 2000 - 100 * j);
    }
    if ((app.inputs().flags & kImuFresh) != 0) {
      ASSERT_EQ(app.inputs().accel_count[2], 4096);
    }
    ASSERT_EQ(app.inputs().flags & kOverrun, 0);
  }
  EXPECT_EQ(app.inputs().tick, static_cast<std::uint32_t>(kTicks - 1));
  EXPECT_GT(fresh, kTicks * kJoints / 3);
  EXPECT_GT(app.crc_errors(), 100u);
  tap.faults_per_mille = 0;
  ticks(2);
  EXPECT_EQ(app.inputs().fresh, all());
}

}  // namespace
}  // namespace verp::test
