#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"
#include "firmware/app/feetech_schedule.hpp"
#include "tests/host/bus/app_fixture.hpp"

// The loop with Feetech servos in the twin.
namespace verp::test {
namespace {

namespace mem = feetech::address;

class FeetechLoop : public ::testing::Test {
 protected:
  static constexpr int kJoints = 21;
  FeetechLoop() {
    wanted = {};
    plant.rated.nominal_v = 7.4;
    for (int j = 0; j < kJoints; ++j) {
      wanted.goal_count[j] = 2000 + j;
      measured(j).position_count = 2000 + j;
      measured(j).voltage_v = 7.4;
    }
  }
  sim::ServoMeasurement& measured(int joint) {
    return plant.measured[static_cast<std::size_t>(joint)];
  }
  sim::ServoSetpoint& setpoint(int joint) {
    return plant.setpoints[static_cast<std::size_t>(joint)];
  }
  void ready() { ASSERT_EQ(app.bring_up().status, app::BringUpStatus::kReady); }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) app.tick();
  }
  void arm() {
    ready();
    wanted.torque_enable = all();
    ticks(6);
    for (int j = 0; j < kJoints; ++j) ASSERT_TRUE(setpoint(j).torque_on) << j;
  }
  static std::uint32_t all() { return (1u << kJoints) - 1; }
  const Inputs& inputs() const { return memory.records.back().inputs; }
  /// Reads a register past the loop.
  std::vector<std::uint8_t> read(std::uint8_t id, std::uint8_t address, std::uint8_t length) {
    std::uint8_t frame[16], bytes[300];
    bus.send(frame, feetech::encode_read(frame, sizeof frame, id, address, length));
    feetech::Parser parser;
    for (std::size_t count; (count = bus.poll(bytes, sizeof bytes, 5000)) > 0;) {
      for (std::size_t i = 0; i < count; ++i) {
        if (parser.push(bytes[i]))
          return {parser.packet().parameters, parser.packet().parameters + parser.packet().size};
      }
    }
    return {};
  }
  void write(std::uint8_t id, std::uint8_t address, std::vector<std::uint8_t> data) {
    std::uint8_t frame[32], bytes[64];
    bus.send(frame,
             feetech::encode_write(frame, sizeof frame, id, address, data.data(), data.size()));
    bus.poll(bytes, sizeof bytes, 5000);
  }

  Params params = feetech_params(kJoints);
  FakePlant plant;
  bus::VirtualBus bus{params, plant};
  Tap tap{bus};
  Script script;
  Memory memory;
  app::App<Tap, Script, Memory> app{params, tap, script, memory};
};

TEST_F(FeetechLoop, BringUpWritesGainsLimitsAndModeAndLeavesTorqueOff) {
  write(3, mem::kMode, {1});
  write(3, mem::kPhase, {12 | feetech::kWholeAngle});
  params.joint[2].lower_rad = -0.5F;
  params.joint[2].upper_rad = 1.0F;
  ready();
  EXPECT_EQ(read(3, mem::kPGain, 3), (std::vector<std::uint8_t>{97, 32, 3})) << "P, D, I";
  EXPECT_EQ(read(3, mem::kMode, 1), std::vector<std::uint8_t>{0});
  EXPECT_EQ(read(3, mem::kPhase, 1), std::vector<std::uint8_t>{12});
  const auto limits = read(3, mem::kMinPosition, 4);
  EXPECT_EQ(feetech::get_u16(limits.data()), 2048 - 326 - 1);
  EXPECT_EQ(feetech::get_u16(limits.data() + 2), 2048 + 652 + 1);
  EXPECT_EQ(read(3, mem::kLock, 1), std::vector<std::uint8_t>{1});
  EXPECT_FALSE(setpoint(2).torque_on);
}

TEST_F(FeetechLoop, BringUpNamesWhatIsWrong) {
  params.servo[0].model_number = 2825;
  EXPECT_EQ(app.bring_up().status, app::BringUpStatus::kWrongModel);
  params.servo[0].model_number = feetech::kModelSts3215;
  bus.set_connected(5, false);
  const app::BringUpReport silent = app.bring_up();
  EXPECT_EQ(silent.status, app::BringUpStatus::kSilent);
  EXPECT_EQ(silent.device_id, 5);
  bus.set_connected(5, true);
  measured(8).temperature_c = 90;
  const app::BringUpReport hot = app.bring_up();
  EXPECT_EQ(hot.status, app::BringUpStatus::kHardwareError);
  EXPECT_EQ(hot.device_id, 9);
  EXPECT_EQ(hot.found, dxl::kOverheatingError);
}

TEST_F(FeetechLoop, EveryTickBringsPositionsImuFeetAndOneServosHealth) {
  ready();
  measured(1).voltage_v = 7.1;
  measured(1).temperature_c = 41;
  ticks(1);
  EXPECT_EQ(inputs().fresh, all());
  for (int j = 0; j < kJoints; ++j) EXPECT_EQ(inputs().position_count[j], 2000 + j);
  EXPECT_EQ(inputs().flags & (kImuFresh | kFeetFresh | kSlowFresh),
            kImuFresh | kFeetFresh | kSlowFresh);
  EXPECT_EQ(inputs().accel_count[2], 4096);
  EXPECT_EQ(inputs().gyro_count[1], -2);
  EXPECT_EQ(inputs().foot_count[1][3], 203);
  EXPECT_EQ(inputs().slow_joint, 1);
  EXPECT_EQ(inputs().slow_voltage_tenth_v, 71);
  EXPECT_EQ(inputs().slow_temperature_c, 41);
  EXPECT_EQ(app.counters().timeouts, 0u);
}

TEST_F(FeetechLoop, BytesTakeTheirTimeOnTheWire) {
  ready();
  ticks(2);
  bus.let_pass(bus.now_us() + 2000);  // the tick's last packets leave
  const std::uint64_t begun_us = bus.now_us();
  std::uint8_t frame[16], bytes[32];
  const std::size_t size = feetech::encode_read(frame, sizeof frame, 1, mem::kPresentPosition, 2);
  bus.send(frame, size);
  std::size_t heard = 0;
  while (heard < 8) heard += bus.poll(bytes + heard, sizeof bytes - heard, 5000);
  EXPECT_EQ(bus.now_us() - begun_us, 160u) << "16 bytes at 1 Mbaud";
}

TEST_F(FeetechLoop, AWholeTickStaysWithinItsSchedule) {
  arm();
  const std::uint64_t before = bus.bytes_on_wire();
  wanted.mode = 1;  // strength may change
  ticks(1);
  EXPECT_LE(bus.bytes_on_wire() - before, app::serial_tick_bytes(params));
  EXPECT_LE(app::serial_tick_us(params), params.period_us * 8 / 10);
}

TEST_F(FeetechLoop, TorqueAndGoalTravelTogetherWhicheverPacketIsLost) {
  ready();
  for (int j = 0; j < kJoints; ++j) plant.blocked[static_cast<std::size_t>(j)] = true;
  wanted.torque_enable = all();
  tap.lose_sends = 7;
  for (int tick = 0; tick < 8; ++tick) {
    ticks(1);
    for (int j = 0; j < kJoints; ++j) {
      if (!setpoint(j).torque_on) continue;
      EXPECT_EQ(setpoint(j).goal_count, 2000 + j) << "an old goal";
      EXPECT_EQ(setpoint(j).pwm_limit, 885);
    }
  }
  for (int j = 0; j < kJoints; ++j) EXPECT_TRUE(setpoint(j).torque_on) << j;
}

TEST_F(FeetechLoop, StrengthIsTorqueLimit) {
  ready();
  app.limit_torque(30);
  wanted.torque_enable = all();
  ticks(6);
  EXPECT_EQ(setpoint(4).pwm_limit, 266);  // 30 % of 885
}

TEST_F(FeetechLoop, ASilentServoIsNotFreshAndTheOthersAre) {
  arm();
  bus.set_connected(7, false);
  ticks(2);
  EXPECT_EQ(inputs().fresh, all() & ~(1u << 6));
  EXPECT_GT(app.counters().timeouts, 0u);
}

TEST_F(FeetechLoop, AServoThatLostPowerStaysLimpUntilTheRobotIsReleased) {
  arm();
  bus.set_powered(7, false);
  ticks(8);
  measured(6).position_count = 1990;
  bus.set_powered(7, true);
  ticks(10);
  EXPECT_FALSE(setpoint(6).torque_on);
  EXPECT_EQ(inputs().fresh, all() & ~(1u << 6));
  wanted.torque_enable = 0;
  ticks(8);
  EXPECT_EQ(inputs().fresh, all());
  wanted.torque_enable = all();
  ticks(8);
  EXPECT_TRUE(setpoint(6).torque_on);
  EXPECT_EQ(read(7, mem::kPGain, 1), std::vector<std::uint8_t>{97}) << "kept in EEPROM";
}

TEST_F(FeetechLoop, AnAlarmReachesTheCoreAndTorqueThatWentIsNotGivenBack) {
  arm();
  measured(3).temperature_c = 75;
  bool told = false;
  for (int i = 0; i < kJoints + 1; ++i) {
    ticks(1);
    told = told || (inputs().slow_joint == 3 && inputs().slow_error == dxl::kOverheatingError);
  }
  EXPECT_TRUE(told);
  EXPECT_FALSE(setpoint(3).torque_on);
  EXPECT_EQ(inputs().fresh & 1u << 3, 0u);
}

TEST_F(FeetechLoop, OverloadLeavesProtectiveTorqueUntilTorqueIsOff) {
  arm();
  measured(5).duty = 0.9;
  ticks(150);
  EXPECT_EQ(setpoint(5).pwm_limit, 885) << "1.5 s: not yet";
  ticks(100);
  EXPECT_EQ(setpoint(5).pwm_limit, 177) << "20 %";
  EXPECT_EQ(read(6, mem::kStatus, 1)[0] & feetech::kOverloadStatus, feetech::kOverloadStatus);
  measured(5).duty = 0;
  wanted.torque_enable = 0;
  ticks(8);
  EXPECT_EQ(read(6, mem::kStatus, 1)[0] & feetech::kOverloadStatus, 0);
}

TEST_F(FeetechLoop, OffsetsAreSignedMagnitudesAndShiftPositionAndGoal) {
  ready();
  write(2, mem::kLock, {0});
  const std::uint16_t offset = feetech::to_magnitude(-300, feetech::kOffsetSign);
  write(2, mem::kOffset,
        {static_cast<std::uint8_t>(offset), static_cast<std::uint8_t>(offset >> 8)});
  EXPECT_EQ(feetech::get_u16(read(2, mem::kPresentPosition, 2).data()), 2001 + 300);
  write(2, mem::kGoalPosition, {0xFC, 0x08});  // 2300
  EXPECT_EQ(setpoint(1).goal_count, 2000);
  write(2, mem::kTorqueEnable, {feetech::kMakeMiddle});
  EXPECT_EQ(feetech::get_u16(read(2, mem::kPresentPosition, 2).data()), 2048);
  EXPECT_EQ(read(2, mem::kTorqueEnable, 1), std::vector<std::uint8_t>{0});
}

TEST_F(FeetechLoop, EepromForgetsWhatWasWrittenWhileLocked) {
  write(2, mem::kLock, {1});
  write(2, mem::kDGain, {7});
  EXPECT_EQ(read(2, mem::kDGain, 1), std::vector<std::uint8_t>{7});
  bus.set_powered(2, false);
  bus.set_powered(2, true);
  EXPECT_EQ(read(2, mem::kDGain, 1), std::vector<std::uint8_t>{32});
}

TEST_F(FeetechLoop, ANoisyLineCostsReadingsAndNeverGivesAWrongOne) {
  arm();
  tap.faults_per_mille = 8;
  std::uint32_t fresh = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    ticks(1);
    for (int j = 0; j < kJoints; ++j) {
      if ((inputs().fresh >> j & 1) == 0) continue;
      ++fresh;
      // What passes the checksum is at most as far off as a joint may move.
      EXPECT_NEAR(inputs().position_count[j], 2000 + j, 200) << tick;
    }
    if ((inputs().flags & kImuFresh) != 0) {
      EXPECT_EQ(inputs().accel_count[2], 4096) << tick;
    }
  }
  EXPECT_GT(fresh, 3000u * kJoints / 3);
  EXPECT_GT(app.crc_errors(), 100u);
  EXPECT_FALSE(plant.went_back);
}

}  // namespace
}  // namespace verp::test
