#include "firmware/app/canopen_servos.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "common/protocol/canopen/robot_load.hpp"
#include "firmware/app/app.hpp"
#include "tests/unit/can_app/can_loop.hpp"

namespace verp::app {
namespace {

using canopen::cia402::State;
using test::CanBench;
using test::kAll;
using test::kBenchJoints;
using Loop = test::CanLoop;

static_assert(ServoBinding<CanopenServos>);

TEST(CanopenServos, ReadsEveryNodeInEachTickAndSetsItsFlags) {
  Loop& loop = test::new_can_loop();
  loop.up();
  for (int j = 0; j < kBenchJoints; ++j) {
    loop.bench.drives[j].application.objects.actual_position = -1000 - j;
  }
  for (int i = 0; i < 20; ++i) {
    loop.tick();
    EXPECT_EQ(loop.inputs.fresh, kAll);
    EXPECT_EQ(loop.inputs.flags & (kImuFresh | kFeetFresh), kImuFresh | kFeetFresh);
  }
  for (int j = 0; j < kBenchJoints; ++j) EXPECT_EQ(loop.inputs.position_count[j], -1000 - j);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(loop.inputs.gyro_count[i], -10 - i);
    EXPECT_EQ(loop.inputs.accel_count[i], 20 + i);
  }
  for (int i = 0; i < kFootSensors; ++i) {
    EXPECT_EQ(loop.inputs.foot_count[0][i], 30 + i);
    EXPECT_EQ(loop.inputs.foot_count[1][i], 40 + i);
  }
  EXPECT_EQ(loop.servos.counters().timeouts, 0u);
  EXPECT_EQ(loop.servos.counters().refused, 0u);
  EXPECT_EQ(loop.servos.counters().strays, 0u);
}

TEST(CanopenServos, TakesExactlyOnePeriodForATick) {
  Loop& loop = test::new_can_loop();
  loop.up();
  loop.tick();
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t before_us = loop.servos.now_us();
    loop.tick();
    EXPECT_NEAR(static_cast<double>(loop.servos.now_us() - before_us), 10'000.0, 200.0);
  }
}

TEST(CanopenServos, GivesTorqueInTheThirdTickAndOnlyWithGoalsKnown) {
  Loop& loop = test::new_can_loop();
  loop.up();
  loop.run(2);
  loop.outputs.torque_enable = kAll;
  for (int j = 0; j < kBenchJoints; ++j) loop.outputs.goal_count[j] = 200 + j;
  int ticks = 0;
  for (; ticks < 20; ++ticks) {
    loop.tick();
    loop.servos.read_positions(loop.inputs);
    if (!loop.all_in(State::kOperationEnabled)) {
      EXPECT_FALSE(loop.bench.drives[0].state() == State::kOperationEnabled ||
                   loop.bench.drives[6].state() == State::kOperationEnabled)
          << "together";
      continue;
    }
    break;
  }
  EXPECT_GE(ticks, 2);
  EXPECT_LE(ticks, 4);
  for (int j = 0; j < kBenchJoints; ++j) {
    EXPECT_EQ(loop.bench.drives[j].application.objects.actual_position, 200 + j);
  }
}

TEST(CanopenServos, GoalsTakeEffectInTheTickInWhichTheyAreSent) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  ASSERT_TRUE(loop.all_in(State::kOperationEnabled));
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < kBenchJoints; ++j) loop.outputs.goal_count[j] = 1000 * i + j;
    loop.tick();
    loop.tick();
    for (int j = 0; j < kBenchJoints; ++j) {
      EXPECT_EQ(loop.inputs.position_count[j], 1000 * i + j);
    }
  }
}

TEST(CanopenServos, TakesTorqueAtOnceAndOnlyFromWhomItIsTold) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.outputs.torque_enable = kAll & ~4u;
  loop.run(2);
  EXPECT_TRUE(loop.bench.drives[2].state() == State::kSwitchOnDisabled);
  EXPECT_TRUE(loop.bench.drives[3].state() == State::kOperationEnabled);
  loop.outputs.torque_enable = 0;
  loop.run(2);
  EXPECT_TRUE(loop.all_in(State::kSwitchOnDisabled));
}

TEST(CanopenServos, ALostControlwordNeitherLeavesADriveStiffNorLimp) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.bench.deaf_to = canopen::rpdo_id(2, 11);
  loop.outputs.torque_enable = 0;
  loop.run(6);
  EXPECT_TRUE(loop.bench.drives[0].state() == State::kOperationEnabled) << "it cannot know";
  loop.bench.deaf_to = 0;
  loop.run(3);
  EXPECT_TRUE(loop.all_in(State::kSwitchOnDisabled));
}

TEST(CanopenServos, RisesWithTheStrengthThatItsEntityAllows) {
  Loop& loop = test::new_can_loop();
  loop.bench.params.rise_torque_percent = 40;
  loop.up();
  loop.outputs.torque_enable = kAll;
  loop.outputs.mode = static_cast<std::uint8_t>(safety::Mode::kRising);
  loop.run(12);
  ASSERT_TRUE(loop.all_in(State::kOperationEnabled));
  for (const auto& drive : loop.bench.drives) EXPECT_EQ(drive.application.objects.max_torque, 400);
  loop.outputs.mode = static_cast<std::uint8_t>(safety::Mode::kStanding);
  loop.run(4);
  for (const auto& drive : loop.bench.drives) EXPECT_EQ(drive.application.objects.max_torque, 1000);
  loop.servos.limit_torque(25);
  loop.run(4);
  for (const auto& drive : loop.bench.drives) EXPECT_EQ(drive.application.objects.max_torque, 250);
}

TEST(CanopenServos, TellsTheTelemetryOfOneDriveATickInTurn) {
  Loop& loop = test::new_can_loop();
  loop.up();
  for (int j = 0; j < kBenchJoints; ++j) {
    const auto number = static_cast<std::uint8_t>(j);
    loop.bench.drives[j].application.telemetry =
        canopen::plan::Telemetry{static_cast<std::uint16_t>(110 + j),
                                 static_cast<std::uint8_t>(30 + number), number}
            .value();
  }
  loop.run(2);
  std::uint32_t seen = 0;
  for (int i = 0; i < kBenchJoints; ++i) {
    loop.tick();
    ASSERT_TRUE((loop.inputs.flags & kSlowFresh) != 0);
    const int j = loop.inputs.slow_joint;
    EXPECT_EQ(loop.inputs.slow_voltage_tenth_v, 110 + j);
    EXPECT_EQ(loop.inputs.slow_temperature_c, 30 + j);
    EXPECT_EQ(loop.inputs.slow_error, j);
    seen |= 1u << j;
  }
  EXPECT_EQ(seen, kAll);
}

// Another maker's 2001h may hold anything.
TEST(CanopenServos, ADriveOfAnotherMakerIsNotAskedForOurTelemetry) {
  Loop& loop = test::new_can_loop();
  test::DriveNode& drive = loop.bench.drives[3];
  std::destroy_at(&drive);
  std::construct_at(&drive, std::uint8_t{14}, 0x19Au);
  drive.application.telemetry = 0xFFFF'FFFF;
  loop.up();
  int told = 0;
  for (int i = 0; i < 4 * kBenchJoints; ++i) {
    loop.tick();
    if ((loop.inputs.flags & kSlowFresh) == 0 || loop.inputs.slow_joint != 3) continue;
    ++told;
    EXPECT_EQ(loop.inputs.slow_voltage_tenth_v, 123) << "6079h";
    EXPECT_EQ(loop.inputs.slow_temperature_c, 0);
    EXPECT_EQ(loop.inputs.slow_error, 0);
  }
  EXPECT_GE(told, 2);
}

TEST(CanopenServos, TellsEachDrivesVelocityAndTorqueInTurnWithItsTelemetry) {
  Loop& loop = test::new_can_loop();
  loop.up();
  for (int j = 0; j < kBenchJoints; ++j) {
    auto& objects = loop.bench.drives[j].application.objects;
    objects.actual_velocity = j % 2 == 0 ? -100'000 * j : 100'000 * j;
    objects.actual_torque = static_cast<std::int16_t>(-7 * j);
  }
  // A question never shares a tick with a heartbeat.
  int told = 0, ticks = 2 * kBenchJoints * (canopen::plan::kEffortTicks + 1);
  for (int i = 0; i < ticks; ++i) {
    loop.tick();
    told += (loop.inputs.flags & kSlowFresh) != 0 ? 1 : 0;
  }
  EXPECT_GE(told, ticks - 1) << "telemetry has lost no turn to it";
  for (int j = 0; j < kBenchJoints; ++j) {
    const auto& objects = loop.bench.drives[j].application.objects;
    EXPECT_EQ(loop.servos.efforts()[j].velocity, objects.actual_velocity) << j;
    EXPECT_EQ(loop.servos.efforts()[j].torque, objects.actual_torque) << j;
  }
}
TEST(CanopenServos, TellsTheOthersVelocityAndTorqueWhileOneDriveIsGone) {
  Loop& loop = test::new_can_loop();
  loop.up();
  for (test::DriveNode& drive : loop.bench.drives) {
    drive.application.objects.actual_velocity = 1000;
    drive.application.objects.actual_torque = 50;
  }
  loop.bench.drives[2].off = true;
  loop.run(4 * kBenchJoints * (canopen::plan::kEffortTicks + 1));
  for (int j = 0; j < kBenchJoints; ++j) {
    const JointEffort expected = j == 2 ? JointEffort{} : JointEffort{1000, 50};
    EXPECT_EQ(loop.servos.efforts()[j], expected) << j;
  }
}
TEST(CanopenServos, AsksADriveWithAnEmergencyFirstInAnyRound) {
  for (int ticks = 1; ticks < 3 * kBenchJoints; ++ticks) {
    Loop& loop = test::new_can_loop();
    loop.enable();
    loop.run(ticks);
    loop.bench.drives[4].fail(canopen::ErrorCode::kOverTemperature, true);
    bool told = false;
    for (int i = 0; i < 4 && !told; ++i) {
      loop.tick();
      told = (loop.inputs.flags & kSlowFresh) != 0 && loop.inputs.slow_joint == 4;
    }
    EXPECT_TRUE(told) << ticks;
  }
}

// Voltage and error code stand where CiA 402 puts them.
TEST(CanopenServos, TakesVoltageAndErrorOfADriveWithoutOurObject) {
  Loop& loop = test::new_can_loop();
  loop.bench.drives[3].application.has_telemetry = false;
  loop.up();
  loop.bench.drives[3].application.objects.error_code = 0x3220;
  bool told = false;
  for (int i = 0; i < 3 * kBenchJoints; ++i) {
    loop.tick();
    if ((loop.inputs.flags & kSlowFresh) == 0 || loop.inputs.slow_joint != 3) continue;
    told = true;
    EXPECT_EQ(loop.inputs.slow_voltage_tenth_v, 123);
    EXPECT_EQ(loop.inputs.slow_error, dxl::kInputVoltageError);
  }
  EXPECT_TRUE(told);
}

TEST(CanopenServos, HoldsByItselfWhenTheControllerIsGone) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.run(200);
  EXPECT_TRUE(loop.all_in(State::kOperationEnabled)) << "while the heartbeat comes";
  CanFrame frame;
  const std::uint64_t end_us = loop.bench.now_us() + 2'000'000;
  loop.bench.send(canopen::classic_frame(0x7FF, 0));
  while (loop.bench.now_us() < end_us && loop.bench.poll(frame, 2'000'000)) {
  }
  loop.bench.send(canopen::classic_frame(0x7FF, 0));  // asks for pending frames
  while (loop.bench.poll(frame, 1000)) {
  }
  EXPECT_TRUE(loop.all_in(State::kQuickStopActive));
  loop.run(3);
  EXPECT_TRUE(loop.all_in(State::kOperationEnabled)) << "and goes on when it is back";
}

TEST(CanSchedule, CoversTheBitsOfEveryTick) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.run(20);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t before = loop.bench.bits;
    for (int j = 0; j < kBenchJoints; ++j) loop.outputs.goal_count[j] = -i * 77 * j;
    loop.tick();
    const std::uint64_t bits = loop.bench.bits - before;  // a bit is a microsecond
    EXPECT_LE(bits, canopen::plan::tick_us(loop.bench.params));
    EXPECT_GE(bits, canopen::plan::tick_us(loop.bench.params) * 7 / 10)
        << "or it promises too little";
  }
}

// IMU and feet at 125 Hz, worst-case stuffing.
TEST(CanSchedule, TwentyOneDrivesTakeAtMostSeventyPercentOfEightMilliseconds) {
  Params params;
  params.baud = 1'000'000;
  params.joint_count = 21;
  params.imu.device_id = 100;
  params.feet.device_id[0] = 101;
  params.feet.device_id[1] = 102;
  EXPECT_LE(canopen::plan::tick_us(params), 8'000u * 70 / 100);
  std::uint32_t windows_us = 0;
  for (std::uint8_t g = 1; g <= canopen::plan::sync_groups(params); ++g) {
    windows_us += window_us(params, g);
  }
  EXPECT_LE(windows_us, 8'000u) << "nor do timeouts of all groups take more than a tick";
}

struct Desk {
  OperatorOrder order(std::uint32_t) { return {}; }
  void record(const TickRecord& record, const verp::State&, const Outputs&) {
    inputs = record.inputs;
    ++records;
  }
  Inputs inputs;
  int records = 0;
};
TEST(AppOnCan, RecordsWhatTheNodesSay) {
  Loop& loop = test::new_can_loop();
  Desk desk;
  App app(loop.bench.params, loop.bench, desk, desk);
  ASSERT_TRUE(app.bring_up().status == BringUpStatus::kReady);
  loop.bench.drives[4].application.objects.actual_position = -77;
  for (int i = 0; i < 10; ++i) app.tick();
  EXPECT_EQ(desk.records, 10);
  EXPECT_EQ(desk.inputs.tick, 9u);
  EXPECT_EQ(desk.inputs.flags & kOverrun, 0);
  EXPECT_EQ(desk.inputs.fresh, kAll);
  EXPECT_EQ(desk.inputs.position_count[4], -77);
  EXPECT_EQ(desk.inputs.accel_count[2], 22);
}

}  // namespace
}  // namespace verp::app
